// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <set>

#include "tests/bench/report_parts.h"

namespace starfocus::bench {
namespace {

using Cells = std::vector<std::string>;

std::string Line(const Cells& cells, const char* tag = "td", const char* kind = "") {
  std::string text = *kind == 0 ? "<tr>" : "<tr class=\"" + std::string(kind) + "\">";
  for (const std::string& cell : cells) {
    text += "<" + std::string(tag) + ">" + cell + "</" + tag + ">";
  }
  return text + "</tr>\n";
}

std::string Table(const Cells& head, const std::string& body) {
  return "<table>" + Line(head, "th") + body + "</table>\n";
}

double RowPsnr(const Row& row) { return row.benchmark.psnr; }
double Seconds(const Rows& rows) { return Mean(rows, Ms) / 1e3; }

std::string Signed(double value) { return (value > 0 ? "+" : "") + Fixed(value, 1); }

double LayerTime(const Rows& rows, int layer) {
  return 100 * Mean(rows, [&](const Row& row) { return row.layer_time[layer]; });
}

double WithLayers(const Rows& rows, const std::string& field, int layer, const Value& value) {
  return Mean(Filter(rows,
                     [&](const Row& row) {
                       return row.study == "options" && row.field == field &&
                              row.task.max_layer == layer &&
                              row.task.renderer == STARFOCUS_RENDERER_AUTO &&
                              row.task.superblock == 0 && row.task.n_scale == 1 &&
                              std::isfinite(row.quantile);
                     }),
              value);
}

Cells FieldCells(const Rows& rows, const std::string& field, double aperture) {
  const auto of = [&](const char* mode, int views) {
    return AtQuantiles(rows, field, mode, aperture, views);
  };
  const Rows frame = of("frame", 0), blur = of("blur", 0), block = of("block", 0);
  const double psnr = Mean(block, RowPsnr), seconds = Seconds(block);
  Cells cells = {Escape(field) + ", u<sub>t</sub> " + Fixed(aperture, 2),
                 Fixed(Mean(frame, RowPsnr), 1), Fixed(Mean(blur, RowPsnr), 1), Fixed(psnr, 1)};
  for (const int views : {9, 5}) cells.push_back(Signed(Mean(of("block", views), RowPsnr) - psnr));
  for (const Rows* some : {&frame, &blur, &block}) cells.push_back(Fixed(Seconds(*some), 3));
  for (int layer = 0; layer < STARFOCUS_LAYERS; ++layer) {
    cells.push_back(Fixed(LayerTime(block, layer), 0) + " %");
  }
  cells.push_back(Fixed(Seconds(frame) / seconds, 1));
  cells.push_back(Fixed(Seconds(blur) / seconds, 2));
  if (aperture != 1) return cells.resize(17, "–"), cells;
  double before = Mean(frame, Ms);
  for (int layer = 0; layer < STARFOCUS_LAYERS; ++layer) {
    const double now = layer == 2 ? Mean(block, Ms) : WithLayers(rows, field, layer, Ms);
    cells.push_back(Fixed(before / now, 1) + "×");
    before = now;
  }
  return cells;
}

// The paper's Table IV, its averages and three of its light fields.
const Cells kPaperFour[] = {
    {"paper: Tsukuba", "58.0", "33.6", "47.7", "-1.0", "-1.3", "1.7", "0.2", "1.1", "92 %", "5 %",
     "3 %", "1.5", "0.2", "1.0×", "1.4×", "1.0×"},
    {"paper: StillLife", "57.6", "41.3", "46.1", "0.0", "0.0", "9.4", "1.5", "1.3", "76 %", "17 %",
     "7 %", "7.1", "1.2", "1.7×", "3.5×", "1.2×"},
    {"paper: Microcity", "61.2", "40.9", "45.2", "-0.1", "-0.1", "19.5", "2.4", "3.3", "78 %",
     "15 %", "7 %", "5.8", "0.7", "1.5×", "3.2×", "1.2×"},
    {"paper: average of 14, u<sub>t</sub> 1", "59.2", "41.7", "47.9", "-0.2", "-0.2", "50.2", "9.6",
     "4.3", "77 %", "16 %", "7 %", "9.7", "1.6", "1.9×", "3.6×", "1.3×"},
    {"paper: average of 14, u<sub>t</sub> 0.5", "57.8", "44.0", "49.8", "-0.4", "-0.4", "17.2",
     "2.6", "1.5", "78 %", "16 %", "6 %", "8.5", "1.2", "2.2×", "2.9×", "1.2×"},
    {"paper: average of 14, u<sub>t</sub> 0.25", "56.6", "45.5", "51.9", "-0.3", "-0.3", "7.3",
     "0.8", "0.9", "84 %", "14 %", "2 %", "5.3", "0.6", "2.5×", "1.9×", "1.1×"},
};

}  // namespace

std::string TableFour(const Rows& rows) {
  std::set<double, std::greater<>> apertures;
  for (const Row& row : rows) {
    if (row.study == "main" && std::isfinite(row.quantile)) apertures.insert(row.aperture);
  }
  std::string body;
  for (const double aperture : apertures) {
    for (const std::string& field : FieldNames(rows)) {
      body += Line(FieldCells(rows, field, aperture));
    }
  }
  for (const Cells& cells : kPaperFour) body += Line(cells, "td", "paper");
  return "<p>Our Table IV: PSNR against the benchmark in dB (change for fewer views), seconds, "
         "shares "
         "of the run time by layer, how many times block mode is as fast as frame and blur, and "
         "the "
         "gain of each ingredient. Means over quantiles of the disparity map.</p>" +
         Table({"light field", "frame", "blur", "block", "9 views", "5 views", "s frame", "s blur",
                "s block", "L 0", "L 1", "L 2", "times as fast as frame", "as blur", "blocks",
                "+ L 1", "+ L 2"},
               body);
}

std::string ScaleTable(const Rows& rows) {
  // The plain mode's row is that of scale 1, and the measure of the others.
  std::set<double> scales = {1};
  for (const Row& row : rows) scales.insert(row.task.n_scale);
  if (scales.size() == 1) return "<p>Not measured.</p>";
  std::string body;
  for (const std::string& field : FieldNames(rows)) {
    for (const char* mode : {"block", "frame"}) {
      const double whole = Mean(AtQuantiles(rows, field, mode, 1, 0), Ms);
      for (const double scale : scales) {
        const Rows some =
            scale == 1 ? AtQuantiles(rows, field, mode, 1, 0) : Filter(rows, [&](const Row& row) {
              return row.field == field && row.task.mode == mode && row.task.n_scale == scale &&
                     std::isfinite(row.quantile);
            });
        const auto views = [](const Row& row) { return row.rendered_samples / (3 * row.pixels()); };
        body += Line({Escape(field) + ", " + mode, Fixed(scale, 2), Fixed(Mean(some, views), 1),
                      Fixed(Mean(some, Ms), 1), Fixed(whole / Mean(some, Ms), 2),
                      Fixed(Mean(some, RowPsnr), 2),
                      Fixed(Mean(some, [](const Row& row) { return row.benchmark.band; }), 2)});
      }
    }
  }
  return "<p>The rule's N times a factor, rounded up. Means over quantiles of the disparity map; "
         "PSNR is against the benchmark, in dB, and in the band within r<sub>max</sub> of depth "
         "edges.</p>" +
         Table({"light field, mode", "scale", "samples rendered per sample", "ms",
                "times as fast as scale 1", "PSNR", "PSNR in the band"},
               body);
}

std::string TableTwo(const Rows& rows) {
  std::string body;
  for (const std::string& field : FieldNames(rows)) {
    Cells cells = {Escape(field)};
    for (const char* mode : {"frame", "benchmark"}) {
      const Rows some = AtQuantiles(rows, field, mode, 1, 0);
      cells.push_back(Fixed(Mean(some, [](const Row& row) { return row.msamples_per_s(); }), 0));
    }
    for (const char* mode : {"frame", "block", "blur"}) {
      const Rows some = AtQuantiles(rows, field, mode, 1, 0);
      cells.push_back(Fixed(Mean(some, [](const Row& row) { return row.ns_per_pixel(); }), 0));
    }
    const Rows block = AtQuantiles(rows, field, "block", 1, 0);
    cells.push_back(
        Fixed(Mean(block, [](const Row& row) { return double(row.workspace) / 1024; }), 0));
    cells.push_back(Fixed(100 * Mean(block, [](const Row& row) { return row.spread; }), 1) + " %");
    body += Line(cells);
  }
  for (const auto& [name, line, vsrs] :
       {std::make_tuple("Tsukuba", "210.3", "5.4"), std::make_tuple("Lego Knights", "202.5", "6.5"),
        std::make_tuple("Kid and Cat", "205.0", "6.6"),
        std::make_tuple("Kid and Ball", "201.9", "6.6")}) {
    body += Line({"paper: " + std::string(name) + ", one line scan (VSRS-1D-Fast)",
                  std::string(line) + " (" + vsrs + ")", "", "", "", "", "", ""},
                 "td", "paper");
  }
  return "<p>Our Table II: rendered samples per second. Ours are whole frames over the "
         "two-dimensional aperture, the paper's are 5×1 views with N = 16.</p>" +
         Table({"light field", "Msample/s frame", "Msample/s benchmark", "ns/pixel frame",
                "ns/pixel block", "ns/pixel blur", "workspace, block (KiB)", "spread, block"},
               body);
}

std::string TruthTable(const Rows& rows) {
  std::string body;
  std::set<std::string> seen;  // a truth's focus may be a quantile too, a scale of N be 1
  for (const Row& row : rows) {
    if (!std::isfinite(row.truth.psnr) || row.study == "targets") continue;
    const std::string picture = Escape(row.field) + " " + std::to_string(row.width) + "×" +
                                std::to_string(row.height) + ", d<sub>t</sub> " +
                                Fixed(row.focus, 1) + ", u<sub>t</sub> " + Fixed(row.aperture, 1) +
                                ", r<sub>max</sub> " + Fixed(row.r_max, 1);
    if (!seen.insert(picture + Method(row)).second) continue;
    body += Line({picture, Escape(Method(row)), Fixed(row.ms, 1), Fixed(100 * row.spread, 0) + " %",
                  Fixed(row.truth.psnr, 2), Fixed(row.truth.band, 2), Fixed(row.truth.worst, 1),
                  Fixed(row.truth.ssim, 4)});
  }
  if (body.empty()) return "<p>No light field has a truth.</p>";
  return "<p>Times of other programs are what one more picture costs; the ratio of their unit to "
         "the blur radius is the one that suits them best. The band is what lies within "
         "r<sub>max</sub> of depth edges.</p>" +
         Table({"picture", "method", "ms", "spread", "PSNR", "PSNR in the band",
                "worst 16×16 block", "SSIM"},
               body);
}

std::string TargetTable(const Rows& rows) {
  const Rows some = Filter(rows, [](const Row& row) { return row.study == "targets"; });
  std::vector<std::string> targets;
  for (const Row& row : some) {
    if (std::find(targets.begin(), targets.end(), row.task.target) == targets.end()) {
      targets.push_back(row.task.target);
    }
  }
  if (targets.empty()) return "<p>Not measured.</p>";
  Cells head = {"ms at the middle quantile"};
  head.insert(head.end(), targets.begin(), targets.end());
  std::string body;
  for (const std::string& field : FieldNames(some.empty() ? some : rows)) {
    for (const char* mode : {"block", "frame", "blur"}) {
      Cells cells = {Escape(field) + ", " + mode};
      for (const std::string& target : targets) {
        const Rows one = Filter(some, [&](const Row& row) {
          return row.field == field && row.task.mode == mode && row.task.target == target;
        });
        cells.push_back(Fixed(Mean(one, Ms), 1));
      }
      body += Line(cells);
    }
  }
  return Table(head, body);
}

std::string WorkerTable(const Rows& rows) {
  const Rows some = Filter(rows, [](const Row& row) { return row.study == "workers"; });
  if (some.empty()) return "<p>Not measured.</p>";
  std::string body;
  double one = kNone, least_one = kNone;
  for (const Row& row : some) {
    if (row.task.workers == 1) one = row.wall_ms, least_one = row.least_wall_ms;
    body += Line({Escape(row.field) + ", " + row.task.mode, std::to_string(row.task.workers),
                  Fixed(row.wall_ms, 1), Fixed(one / row.wall_ms, 2), Fixed(row.least_wall_ms, 1),
                  Fixed(least_one / row.least_wall_ms, 2)});
  }
  return "<p>By the wall clock inside <code>starfocus_refocus</code>, which also counts what the "
         "machine "
         "does for others meanwhile: the least of a busy machine says more than the median.</p>" +
         Table({"light field, mode", "workers", "ms", "times as fast as one", "least ms",
                "times as fast as one"},
               body);
}

std::string CountTable(const std::vector<Counts>& counts) {
  if (counts.empty()) return "<p>Not measured.</p>";
  std::string body;
  for (const Counts& each : counts) {
    body += Line({Escape(each.name), Fixed(each.x86_simd, 0), Fixed(each.x86_plain, 0),
                  Fixed(each.x86_plain / each.x86_simd, 2), Fixed(each.arm_simd, 0),
                  Fixed(each.arm_plain, 0), Fixed(each.arm_plain / each.arm_simd, 2)});
  }
  return "<p>Counted inside the engine, repeating exactly; from the tracked baselines "
         "(<code>./do bench --check</code> by callgrind, <code>./do count</code> by an emulator), "
         "not of this run. No board was at hand: what the emulated AArch64 executes stands in for "
         "energy, without what memory costs. Cases are views, scene, mode and largest blur "
         "radius, 192×128 pixels, rooms 384×256.</p>" +
         Table({"case", "x86-64 AVX2", "plain C++", "ratio", "AArch64 NEON", "plain C++", "ratio"},
               body);
}

}  // namespace starfocus::bench
