// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/report.h"

#include "tests/bench/report_parts.h"

namespace starfocus::bench {
namespace {

const char kHead[] =
    "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
    "<title>starfocus: time and error</title>\n<style>\n"
    "body{font:15px/1.45 sans-serif;max-width:1320px;margin:2em auto;padding:0 1em;color:#222}\n"
    "table{border-collapse:collapse;margin:.6em 0 1.6em;font-size:14px}\n"
    "th,td{padding:.2em .7em;text-align:right;border-bottom:1px solid #ddd}\n"
    "th{border-bottom:2px solid #888;vertical-align:bottom}\n"
    "th:first-child,td:first-child{text-align:left}\n"
    ".paper{color:#777}\nfigure{display:inline-block;margin:0 .5em 1.2em 0;width:640px;"
    "vertical-align:top}\nfigcaption{font-size:13px;color:#444;padding:0 1em}\n"
    "svg{max-width:100%;height:auto}\n</style></head><body>\n<h1>starfocus: time and error</h1>\n";

std::string About(const Findings& findings) {
  const Machine& machine = findings.machine;
  std::string text =
      "<p>" +
      Escape("starfocus " + machine.version + ", " + machine.compiler + ", " + machine.cpu +
             ", best SIMD target " + machine.target) +
      ", one worker but where it says otherwise. Times are processor time, medians "
      "of interleaved repetitions inside "
      "<code>starfocus_refocus</code>; PSNR is over all R, G, B samples, at most 99 dB. "
      "What is the paper's is grey and was measured on its 3.4 GHz CPU with its own "
      "light fields: compare ratios, not times.</p>\n";
  if (!findings.missing.empty()) {
    text += "<p>Rivals left out because they are not installed:";
    for (const std::string& name : findings.missing) text += " " + Escape(name);
    text += ".</p>\n";
  }
  return text;
}

}  // namespace

std::string MakeReport(const Findings& findings) {
  const std::vector<Row>& rows = findings.rows;
  std::string page = kHead + About(findings);
  page += "<h2>Averages over the focus values</h2>\n" + TableFour(rows);
  page += "<h2>Time and error</h2>\n" + PlanePlots(rows);
  page += "<h2>Scales of N</h2>\n" + ScaleTable(rows);
  page += "<h2>Against ray-traced truth, with rivals</h2>\n" + TruthTable(rows);
  page += "<h2>Along the focus (the paper's Figs. 22 and 23), aperture 1</h2>\n";
  page += FocusPlots(rows);
  page += "<h2>Growth</h2>\n" + GrowthPlots(rows);
  page += "<h2>Layers of block mode</h2>\n" + LayerPlot(rows);
  page += "<h2>Throughput</h2>\n" + TableTwo(rows);
  page += "<h2>SIMD targets</h2>\n" + TargetTable(rows);
  page += "<h2>Workers</h2>\n" + WorkerTable(rows);
  page += "<h2>Instructions per pixel</h2>\n" + CountTable(findings.counts);
  page += "</body></html>\n";
  return page;
}

}  // namespace starfocus::bench
