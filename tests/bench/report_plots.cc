// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "platform/gnuplot.h"
#include "tests/bench/metrics.h"
#include "tests/bench/report_parts.h"

namespace starfocus::bench {
namespace {

struct Curve {
  std::string name;
  std::vector<std::pair<double, double>> points;
};

struct Drawing {
  std::string title, x, y, settings, caption;
  int height = 430;
  const char* style = "linespoints";
  double size = 0.7;  // of points
  std::vector<Curve> curves;
  Curve front;  // a line behind them, when it has points
};

std::string Quote(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' || c == '\\' ? ' ' : c;
  return quoted + "\"";
}

std::string Script(const Drawing& drawing) {
  static int number = 0;  // SVG names must differ within a page
  std::string script = "set terminal svg size 640," + std::to_string(drawing.height) +
                       " dynamic font 'sans-serif,13' name 'p" + std::to_string(number++) +
                       "'\nset encoding utf8\nset grid lc rgb '#dddddd'\n";
  script += "set title " + Quote(drawing.title) + " noenhanced\nset xlabel " + Quote(drawing.x) +
            " noenhanced\nset bmargin 6\nset ylabel " + Quote(drawing.y) +
            "\nset key outside bottom horizontal noenhanced\n";
  // gnuplot's yellow is hard to see on white.
  script += drawing.settings + "set linetype 5 lc rgb '#a67c00'\nplot ";
  std::string data;
  const auto add = [&](const Curve& curve) {
    for (const auto& [x, y] : curve.points) {
      data += std::to_string(x) + " " + std::to_string(y) + "\n";
    }
    data += "e\n";
  };
  if (!drawing.front.points.empty()) {
    script += "'-' using 1:2 with lines lw 2 lc rgb '#bbbbbb' title " + Quote(drawing.front.name);
    if (!drawing.curves.empty()) script += ", ";
    add(drawing.front);
  }
  for (size_t i = 0; i < drawing.curves.size(); ++i) {
    const Curve& curve = drawing.curves[i];
    if (i > 0) script += ", ";
    script += "'-' using 1:2 with " + std::string(drawing.style) + " lw 2 pt " +
              std::to_string(5 + i % 9) + " lc " + std::to_string(1 + i % 8) + " ps " +
              Fixed(drawing.size, 1) + " title " + Quote(curve.name);
    add(curve);
  }
  return script + "\n" + data;
}

std::string Draw(Drawing drawing) {
  auto& curves = drawing.curves;
  curves.erase(std::remove_if(curves.begin(), curves.end(),
                              [](const Curve& curve) { return curve.points.empty(); }),
               curves.end());
  if (curves.empty()) return "";
  const Result<Bytes> svg = RunGnuplot(drawing.title, Script(drawing));
  std::string text(svg->begin(), svg->end());
  text.erase(0, std::min(text.find("<svg"), text.size()));
  if (!svg) text = "<p>No drawing: " + Escape(svg.error().line()) + "</p>";
  return "<figure>" + text + "<figcaption>" + drawing.caption + "</figcaption></figure>\n";
}

Curve MakeCurve(const Rows& rows, const std::string& name, const Value& x, const Value& y) {
  Curve curve = {name, {}};
  for (const Row& row : rows) {
    if (std::isfinite(x(row)) && std::isfinite(y(row))) curve.points.push_back({x(row), y(row)});
  }
  std::sort(curve.points.begin(), curve.points.end());
  return curve;
}

double Focus(const Row& row) { return row.focus; }

// The mean of each method over the pictures that have the quality.
std::string Plane(const Rows& rows, const std::string& field, const char* against,
                  const Value& quality) {
  Drawing drawing;
  drawing.title = field + ": mean time and PSNR against " + against;
  drawing.x = "ms per picture";
  drawing.y = "PSNR, dB";
  drawing.style = "points";
  drawing.size = 1;
  drawing.settings = "set logscale x\nset offsets graph 0.05, graph 0.05, graph 0.05, graph 0.05\n";
  const Rows kept = Filter(rows, [&](const Row& row) {
    return row.field == field && row.aperture == 1 && std::isfinite(quality(row)) &&
           (row.study == "main" || row.study == "views" || row.study == "options" ||
            row.study == "rivals");
  });
  std::vector<Point> points;
  for (const Row& row : kept) {
    const std::string name = Method(row);
    const auto known = std::find_if(drawing.curves.begin(), drawing.curves.end(),
                                    [&](const Curve& curve) { return curve.name == name; });
    if (known != drawing.curves.end()) continue;
    const Rows same = Filter(kept, [&](const Row& other) { return Method(other) == name; });
    points.push_back({Mean(same, Ms), Mean(same, quality)});
    drawing.curves.push_back({name, {{points.back().time, points.back().quality}}});
  }
  // Below the axis the names, two in a line, and that of the front.
  const int lines = static_cast<int>(drawing.curves.size()) / 2 + 1;
  drawing.height = 350 + 20 * lines;
  drawing.settings += "set bmargin " + std::to_string(lines + 5) + "\n";
  drawing.caption = "Pareto front, from the fastest:";
  drawing.front.name = "Pareto front";
  for (const size_t i : ParetoFront(points)) {
    drawing.front.points.push_back({points[i].time, points[i].quality});
    drawing.caption += " <b>" + Escape(drawing.curves[i].name) + "</b> (" +
                       Fixed(points[i].time, 1) + " ms, " + Fixed(points[i].quality, 1) + " dB);";
  }
  if (!drawing.caption.empty()) drawing.caption.back() = '.';
  return Draw(drawing);
}

}  // namespace

std::string PlanePlots(const Rows& rows) {
  std::string text;
  for (const std::string& field : FieldNames(rows)) {
    text += Plane(rows, field, "truth", [](const Row& row) { return row.truth.psnr; });
    // Rivals are measured at the truths' focus values alone: means over other pictures than the
    // modes' would mislead.
    text += Plane(rows, field, "the benchmark", [](const Row& row) {
      return std::isfinite(row.quantile) ? row.benchmark.psnr : kNone;
    });
  }
  return text;
}

std::string FocusPlots(const Rows& rows) {
  std::string text;
  for (const std::string& field : FieldNames(rows)) {
    Drawing quality, time;
    quality.title = field + ": PSNR against the benchmark";
    quality.y = "PSNR, dB";
    time.title = field + ": time";
    time.y = "ms";
    time.settings = "set logscale y\n";
    quality.x = time.x = "disparity in focus, d_t";
    for (const char* mode : {"frame", "block", "blur"}) {
      const Rows some = AtQuantiles(rows, field, mode, 1, 0);
      quality.curves.push_back(
          MakeCurve(some, mode, Focus, [](const Row& row) { return row.benchmark.psnr; }));
      time.curves.push_back(MakeCurve(some, mode, Focus, Ms));
    }
    for (const int views : {9, 5}) {
      const Rows some = AtQuantiles(rows, field, "block", 1, views);
      const std::string name = "block, " + std::to_string(views) + " views";
      quality.curves.push_back(
          MakeCurve(some, name, Focus, [](const Row& row) { return row.benchmark.psnr; }));
      time.curves.push_back(MakeCurve(some, name, Focus, Ms));
    }
    text += Draw(quality) + Draw(time);
  }
  return text;
}

namespace {

std::string Growth(const Rows& rows, const char* study, const char* title, const char* x,
                   double from, const Value& value) {
  Drawing drawing;
  drawing.title = title;
  drawing.x = x;
  drawing.y = "ms";
  drawing.settings = "set logscale xy\n";
  drawing.caption = "Slopes from " + Fixed(from, 2) + " on:";
  for (const char* mode : {"frame", "block", "blur"}) {
    const Rows some =
        Filter(rows, [&](const Row& row) { return row.study == study && row.task.mode == mode; });
    Curve curve = MakeCurve(some, mode, value, Ms);
    std::vector<double> xs, ys;
    for (const auto& [place, ms] : curve.points) {
      if (place < from) continue;
      xs.push_back(place);
      ys.push_back(ms);
    }
    curve.name += ", slope " + Fixed(xs.size() < 2 ? kNone : LogSlope(xs, ys), 2);
    drawing.caption += " " + curve.name + ";";
    drawing.curves.push_back(curve);
  }
  drawing.caption.back() = '.';
  return Draw(drawing);
}

}  // namespace

std::string GrowthPlots(const Rows& rows) {
  const auto swept = [](const Row& row) { return row.study == "radius" || row.study == "pixels"; };
  if (std::none_of(rows.begin(), rows.end(), swept)) return "<p>Not measured.</p>";
  // A blur radius of 0 stands at 0.5 on the logarithmic axis.
  return Growth(rows, "radius", "Time against the largest blur radius (0 drawn at 0.5)",
                "r_max, pixels", 4, [](const Row& row) { return std::max(0.5, row.r_max); }) +
         Growth(rows, "pixels", "Time against the size, r_max 8, 5 views", "megapixels", 0.45,
                [](const Row& row) { return row.pixels() / 1e6; });
}

std::string LayerPlot(const Rows& rows) {
  std::string script =
      "set terminal svg size 640,430 dynamic font 'sans-serif,13' name 'layers'\n"
      "set encoding utf8\nset style data histogram\nset style histogram rowstacked\n"
      "set style fill solid 0.8\nset boxwidth 0.7\nset yrange [0:100]\nset ylabel 'share, %'\n"
      "set key outside bottom horizontal\nset xtics rotate by -30\n"
      "set title 'Shares of the layers, time (t) and pixels (p), aperture 1'\n$data << END\n";
  for (const std::string& field : FieldNames(rows)) {
    const Rows some = AtQuantiles(rows, field, "block", 1, 0);
    std::string time = field + "-t", pixels = field + "-p";
    for (int i = 0; i < STARFOCUS_LAYERS; ++i) {
      time += " " + Fixed(100 * Mean(some, [&](const Row& row) { return row.layer_time[i]; }), 1);
      pixels +=
          " " + Fixed(100 * Mean(some, [&](const Row& row) { return row.layer_pixels[i]; }), 1);
    }
    script += time + "\n" + pixels + "\n";
  }
  script += "END\nplot for [i=2:4] $data using i:xtic(1) title 'L = '.(i-2)\n";
  const Result<Bytes> svg = RunGnuplot("layers", script);
  if (!svg) return "<p>No drawing: " + Escape(svg.error().line()) + "</p>";
  const std::string text(svg->begin(), svg->end());
  return "<figure>" + text.substr(std::min(text.find("<svg"), text.size())) + "</figure>\n";
}

}  // namespace starfocus::bench
