# SPDX-License-Identifier: Apache-2.0
"""Converts the rows of starfocus-bench to an HTML page.

usage: report.py RESULTS.json X86-COUNTS ARM-COUNTS > report.html

X86-COUNTS and ARM-COUNTS are the baselines of `./do bench --check` and `toolchains/board/board count`. The plots need gnuplot. Without
gnuplot the page has messages instead of plots.
"""
import html
import itertools
import json
import math
import shutil
import subprocess
import sys

RIVALS = {"ffmpeg-varblur": "ffmpeg", "gegl-lens-blur": "gegl", "imagemagick-blur": "convert-im6.q16"}
LAYERS = range(3)
HEAD = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
<title>starfocus: time and error</title>
<style>
body{font:15px/1.45 sans-serif;max-width:1320px;margin:2em auto;padding:0 1em;color:#222}
table{border-collapse:collapse;margin:.6em 0 1.6em;font-size:14px}
th,td{padding:.2em .7em;text-align:right;border-bottom:1px solid #ddd}
th{border-bottom:2px solid #888;vertical-align:bottom}
th:first-child,td:first-child{text-align:left}
.paper{color:#777}
figure{display:inline-block;margin:0 .5em 1.2em 0;width:640px;vertical-align:top}
figcaption{font-size:13px;color:#444;padding:0 1em}
svg{max-width:100%;height:auto}
</style></head><body>
<h1>starfocus: time and error</h1>
"""
# Rows of the paper's Table IV: three of the paper's light fields, and the averages.
PAPER_FOUR = """
Tsukuba|58.0|33.6|47.7|-1.0|-1.3|1.7|0.2|1.1|92 %|5 %|3 %|1.5|0.2|1.0×|1.4×|1.0×
StillLife|57.6|41.3|46.1|0.0|0.0|9.4|1.5|1.3|76 %|17 %|7 %|7.1|1.2|1.7×|3.5×|1.2×
Microcity|61.2|40.9|45.2|-0.1|-0.1|19.5|2.4|3.3|78 %|15 %|7 %|5.8|0.7|1.5×|3.2×|1.2×
average of 14, u<sub>t</sub> 1|59.2|41.7|47.9|-0.2|-0.2|50.2|9.6|4.3|77 %|16 %|7 %|9.7|1.6|1.9×|3.6×|1.3×
average of 14, u<sub>t</sub> 0.5|57.8|44.0|49.8|-0.4|-0.4|17.2|2.6|1.5|78 %|16 %|6 %|8.5|1.2|2.2×|2.9×|1.2×
average of 14, u<sub>t</sub> 0.25|56.6|45.5|51.9|-0.3|-0.3|7.3|0.8|0.9|84 %|14 %|2 %|5.3|0.6|2.5×|1.9×|1.1×
""".strip().splitlines()
PAPER_TWO = (("Tsukuba", "210.3", "5.4"), ("Lego Knights", "202.5", "6.5"), ("Kid and Cat", "205.0", "6.6"),
             ("Kid and Ball", "201.9", "6.6"))
# Format of a curve. draw() sets line type 5 to a dark yellow, since gnuplot's own is hard to see on white.
CURVE = "'-' using 1:2 with {} lw 2 pt {} lc {} ps {:.1f} title \"{}\""
numbers = itertools.count()  # for the names of plots, which must be unique in the page


def fixed(value, digits):
    """Formats a value. Values that were not measured become a dash."""
    return f"{value:.{digits}f}" if math.isfinite(value) else "–"


def mean(rows, value):
    """Returns the mean of the finite values of the rows. `value` is a key or a function of a row."""
    values = [value(row) if callable(value) else row[value] for row in rows]
    values = [one for one in values if math.isfinite(one)]
    return sum(values) / len(values) if values else math.nan


def in_order(names):
    """Removes duplicates and keeps the order of the first occurrences."""
    return list(dict.fromkeys(names))


def fields_of(rows):
    return in_order(row["field"] for row in rows if row["study"] == "main")


def at_quantiles(rows, field, mode, aperture=1, views=0):
    """Returns the rows whose focus is a quantile of the disparity map, for all views, or for `views` views."""
    return [row for row in rows if row["study"] == ("views" if views else "main") and row["field"] == field
            and row["mode"] == mode and row["aperture"] == aperture and row["views"] in (views or row["views"],)
            and math.isfinite(row["quantile"])]


def method(row):
    """Returns the name of the method of a row, for example "block, 9 views"."""
    name, options = row["mode"], row["study"] == "options"
    if row["study"] == "views" or row["mode"] == "shift-and-add":
        name += f", {row['views']} views"
    if options and row["max_layer"] != LAYERS[-1]:
        name += f", layers to {row['max_layer']}"
    if options and row["superblock_option"] != 0:
        name += f", blocks to {row['superblock_option']}"
    if row["n_scale"] != 1:
        name += f", N × {row['n_scale']:.2f}"
    return name + {"auto": "", "line-scan": ", N by (9)", "slices": ", N by subapertures"}[row["renderer"]]


def table(about, head, lines):
    """Returns an HTML table. Lines whose first cell starts with "paper" are grey."""
    def line(cells, tag="td"):
        kind = ' class="paper"' if cells[0].startswith("paper") else ""
        return f"<tr{kind}>" + "".join(f"<{tag}>{cell}</{tag}>" for cell in cells) + "</tr>\n"

    if not lines:
        return "<p>Not measured.</p>"
    return (f"<p>{about}</p>" if about else "") + "<table>" + line(head, "th") + "".join(map(line, lines)) + "</table>\n"


def table_four(rows):
    """Returns our Table IV together with rows of the paper's Table IV."""
    def cells(field, aperture):
        def of(mode, views=0):
            return at_quantiles(rows, field, mode, aperture, views)

        def with_layers(layer):
            return mean([row for row in rows if row["study"] == "options" and row["field"] == field
                         and row["max_layer"] == layer and row["renderer"] == "auto" and row["superblock_option"] == 0
                         and row["n_scale"] == 1 and math.isfinite(row["quantile"])], "ms")

        three = [of("frame"), of("blur"), of("block")]
        frame, blur, block = (mean(some, "ms") for some in three)
        psnr = [mean(some, "psnr_benchmark") for some in three]
        made = [f"{html.escape(field, False)}, u<sub>t</sub> {aperture:.2f}"] + [fixed(one, 1) for one in psnr]
        for views in (9, 5):
            less = mean(of("block", views), "psnr_benchmark") - psnr[2]
            made.append(("+" if less > 0 else "") + fixed(less, 1))
        made += [fixed(ms / 1e3, 3) for ms in (frame, blur, block)]
        made += [fixed(100 * mean(three[2], f"time_share_layer_{layer}"), 0) + " %" for layer in LAYERS]
        made += [fixed(frame / block, 1), fixed(blur / block, 2)]
        steps = [frame, with_layers(0), with_layers(1), block] if aperture == 1 else []
        made += [fixed(before / now, 1) + "×" for before, now in zip(steps, steps[1:])]
        return made + ["–"] * (17 - len(made))

    apertures = sorted({row["aperture"] for row in rows if row["study"] == "main" and math.isfinite(row["quantile"])})
    return table("Our Table IV: PSNR against the benchmark in dB (change for fewer views), seconds, shares of the run "
                 "time by layer, how many times block mode is as fast as frame and blur, and the gain of each "
                 "ingredient. Means over quantiles of the disparity map.",
                 ["light field", "frame", "blur", "block", "9 views", "5 views", "s frame", "s blur", "s block", "L 0",
                  "L 1", "L 2", "times as fast as frame", "as blur", "blocks", "+ L 1", "+ L 2"],
                 [cells(field, aperture) for aperture in reversed(apertures) for field in fields_of(rows)]
                 + [("paper: " + line).split("|") for line in PAPER_FOUR])


def scale_table(rows):
    # The row with n_scale = 1 shows the mode without options. Rows with another n_scale are relative to the row with
    # n_scale = 1.
    scales = sorted({1, *(row["n_scale"] for row in rows)})
    lines = []
    for field, mode, scale in itertools.product(fields_of(rows), ("block", "frame"), scales):
        some = whole = at_quantiles(rows, field, mode)
        if scale != 1:
            some = [row for row in rows if row["field"] == field and row["mode"] == mode and row["n_scale"] == scale
                    and math.isfinite(row["quantile"])]
        views = mean(some, lambda row: row["rendered_samples"] / (3 * row["width"] * row["height"]))
        ms = mean(some, "ms")
        lines.append([f"{html.escape(field, False)}, {mode}", fixed(scale, 2), fixed(views, 1), fixed(ms, 1),
                      fixed(mean(whole, "ms") / ms, 2), fixed(mean(some, "psnr_benchmark"), 2),
                      fixed(mean(some, "edge_band_psnr_benchmark"), 2)])
    return table("The rule's N times a factor, rounded up. Means over quantiles of the disparity map; PSNR is against "
                 "the benchmark, in dB, and in the band within r<sub>max</sub> of depth edges.",
                 ["light field, mode", "scale", "samples rendered per sample", "ms", "times as fast as scale 1", "PSNR",
                  "PSNR in the band"], lines if len(scales) > 1 else [])


def table_two(rows):
    """Returns our Table II together with rows of the paper's Table II."""
    lines = []
    for field in fields_of(rows):
        def of(mode, value):
            return mean(at_quantiles(rows, field, mode), value)

        lines.append([html.escape(field, False)] + [fixed(of(mode, "msamples_per_s"), 0) for mode in ("frame", "benchmark")]
                     + [fixed(of(mode, "ns_per_pixel"), 0) for mode in ("frame", "block", "blur")]
                     + [fixed(of("block", "workspace_bytes") / 1024, 0), fixed(100 * of("block", "spread"), 1) + " %"])
    lines += [[f"paper: {name}, one line scan (VSRS-1D-Fast)", f"{ours} ({vsrs})"] + [""] * 6 for name, ours, vsrs in PAPER_TWO]
    return table("Our Table II: rendered samples per second. Ours are whole frames over the two-dimensional aperture, "
                 "the paper's are 5×1 views with N = 16.",
                 ["light field", "Msample/s frame", "Msample/s benchmark", "ns/pixel frame", "ns/pixel block",
                  "ns/pixel blur", "workspace, block (KiB)", "spread, block"], lines)


def truth_table(rows):
    lines = {}  # by picture and method, since a truth may be measured several times
    for row in rows:
        if not math.isfinite(row["psnr_truth"]) or row["study"] == "targets":
            continue
        picture = (f"{html.escape(row['field'], False)} {row['width']}×{row['height']}, d<sub>t</sub> {fixed(row['focus'], 1)}, "
                   f"u<sub>t</sub> {fixed(row['aperture'], 1)}, r<sub>max</sub> {fixed(row['r_max'], 1)}")
        lines.setdefault((picture, method(row)), [
            picture, html.escape(method(row), False), fixed(row["ms"], 1), fixed(100 * row["spread"], 0) + " %",
            fixed(row["psnr_truth"], 2), fixed(row["edge_band_psnr_truth"], 2), fixed(row["worst_block_psnr_truth"], 1),
            fixed(row["ssim_truth"], 4)])
    return table("Times of other programs are what one more picture costs; the ratio of their unit to the blur radius is "
                 "the one that suits them best. The band is what lies within r<sub>max</sub> of depth edges.",
                 ["picture", "method", "ms", "spread", "PSNR", "PSNR in the band", "worst 16×16 block", "SSIM"],
                 list(lines.values()))


def target_table(rows):
    some = [row for row in rows if row["study"] == "targets"]
    targets = in_order(row["simd_target"] for row in some)
    lines = [[f"{html.escape(field, False)}, {mode}"]
             + [fixed(mean([row for row in some if (row["field"], row["mode"], row["simd_target"]) == (field, mode, target)],
                           "ms"), 1) for target in targets]
             for field in fields_of(rows) for mode in ("block", "frame", "blur")]
    return table("", ["ms at the middle quantile"] + targets, lines if targets else [])


def worker_table(rows):
    lines = []
    for row in (row for row in rows if row["study"] == "workers"):
        one = row if row["workers"] == 1 else one  # the row of one worker precedes the others
        lines.append([f"{html.escape(row['field'], False)}, {row['mode']}", str(row["workers"])])
        for key in ("wall_ms", "least_wall_ms"):
            lines[-1] += [fixed(row[key], 1), fixed(one[key] / row[key], 2)]
    return table("By the wall clock inside <code>starfocus_refocus</code>, which also counts what the machine does for "
                 "others meanwhile: the least of a busy machine says more than the median.",
                 ["light field, mode", "workers", "ms", "times as fast as one", "least ms", "times as fast as one"], lines)


def count_table(x86, arm):
    """Reads two files of counts and returns their table.

    Lines of the file for x86-64 are "CASE simd|reference INSTRUCTIONS-PER-PIXEL". Lines of the file for AArch64 are
    "CASE simd|reference PIXELS INSTRUCTIONS". Other lines are ignored.
    """
    counts = {}
    for machine, path in (("x86", x86), ("arm", arm)):
        with open(path, encoding="utf-8") as file:
            for words in map(str.split, file):
                if len(words) > 2 and words[1] in ("simd", "reference"):
                    value = float(words[-1]) / (1 if machine == "x86" else float(words[2]))
                    counts.setdefault(words[0], {})[machine, words[1]] = value
    lines = []
    for name, values in counts.items():
        lines.append([html.escape(name, False)])
        for machine in ("x86", "arm"):
            simd, plain = (values.get((machine, kernels), math.nan) for kernels in ("simd", "reference"))
            lines[-1] += [fixed(simd, 0), fixed(plain, 0), fixed(plain / simd, 2)]
    return table("Counted inside the engine, repeating exactly; from the tracked baselines (<code>./do bench --check</code> "
                 "by callgrind, <code>toolchains/board/board count</code> by an emulator), not of this run. No board was at hand: what the "
                 "emulated AArch64 executes stands in for energy, without what memory costs. Cases are views, scene, mode "
                 "and largest blur radius, 192×128 pixels, rooms 384×256.",
                 ["case", "x86-64 AVX2", "plain C++", "ratio", "AArch64 NEON", "plain C++", "ratio"], lines)


def figure(script, caption):
    """Runs a gnuplot script. Returns an HTML figure with the plot, or with a message if gnuplot fails."""
    try:
        made = subprocess.run(["gnuplot"], input=script, capture_output=True, text=True, check=True).stdout
        drawing = made[made.find("<svg"):]
    except (OSError, subprocess.CalledProcessError) as error:
        drawing = f"<p>No drawing: {html.escape(str(error))} {html.escape(getattr(error, 'stderr', None) or '')}</p>"
    return f"<figure>{drawing}<figcaption>{caption}</figcaption></figure>\n"


def draw(title, axes, curves, settings="", caption="", height=430, style="linespoints", size=0.7, front=()):
    """Plots curves, which are pairs of a name and a list of points. `front` is drawn as a line behind them."""
    curves = [curve for curve in curves if curve[1]]
    if not curves:
        return ""
    parts = [CURVE.format(style, 5 + k % 9, 1 + k % 8, size, name) for k, (name, _) in enumerate(curves)]
    data = [points for _, points in curves]
    if front:
        parts.insert(0, "'-' using 1:2 with lines lw 2 lc rgb '#bbbbbb' title \"Pareto front\"")
        data.insert(0, front)
    lines = "".join("".join(f"{x:f} {y:f}\n" for x, y in points) + "e\n" for points in data)
    return figure(f"set terminal svg size 640,{height} dynamic font 'sans-serif,13' name 'p{next(numbers)}'\n"
                  f"set encoding utf8\nset grid lc rgb '#dddddd'\nset title \"{title}\" noenhanced\nset xlabel \"{axes[0]}\" noenhanced\n"
                  f"set bmargin 6\nset ylabel \"{axes[1]}\"\nset key outside bottom horizontal noenhanced\n{settings}"
                  f"set linetype 5 lc rgb '#a67c00'\nplot {', '.join(parts)}\n{lines}", caption)


def points_of(rows, x, y):
    """Returns the points (x, y) of the rows where both were measured, sorted by x."""
    points = [(x(row) if callable(x) else row[x], row[y]) for row in rows]
    return sorted(point for point in points if all(map(math.isfinite, point)))


def pareto_front(points):
    """Returns the Pareto front of points (time, quality): indices of points that no other point beats in both, sorted by
    time."""
    front = []
    for k in sorted(range(len(points)), key=lambda k: (points[k][0], -points[k][1])):
        if not front or points[k][1] > points[front[-1]][1]:
            front.append(k)
    return front


def log_slope(points):
    """Returns the slope of the least-squares line of log y over log x, or NaN for fewer than two points."""
    u, v = [[math.log(point[k]) for point in points] for k in (0, 1)]
    spread = len(u) * sum(x * x for x in u) - sum(u) ** 2
    return (len(u) * sum(x * y for x, y in zip(u, v)) - sum(u) * sum(v)) / spread if spread > 0 else math.nan


assert pareto_front([(5, 40), (1, 30), (2, 29), (5, 45), (9, 45)]) == [1, 3]
assert abs(log_slope([(1, 3), (2, 12), (4, 48)]) - 2) < 1e-9


def plane(rows, field, against, quality):
    """Plots the mean time and quality of each method over the pictures for which the quality was measured."""
    kept = [row for row in rows if row["field"] == field and row["aperture"] == 1 and math.isfinite(quality(row))
            and row["study"] in ("main", "views", "options", "rivals")]
    curves = [(name, [(mean(same, "ms"), mean(same, quality))]) for name in in_order(map(method, kept))
              for same in [[row for row in kept if method(row) == name]]]
    points = [curve[1][0] for curve in curves]
    front = pareto_front(points)
    # The key below the axis has two names per line, and an additional name for the Pareto front.
    lines = len(curves) // 2 + 1
    caption = "; ".join(f"<b>{html.escape(curves[k][0], False)}</b> ({points[k][0]:.1f} ms, {points[k][1]:.1f} dB)" for k in front)
    return draw(f"{field}: mean time and PSNR against {against}", ("ms per picture", "PSNR, dB"), curves,
                "set logscale x\nset offsets graph 0.05, graph 0.05, graph 0.05, graph 0.05\n"
                f"set bmargin {lines + 5}\n", f"Pareto front, from the fastest: {caption}.", 350 + 20 * lines, "points",
                1, [points[k] for k in front])


def plane_plots(rows):
    # Rivals are measured only at the foci for which a ray-traced picture exists. The plot against the benchmark omits
    # rivals, since means of rivals would cover other pictures than the means of the modes.
    return "".join(plane(rows, field, "truth", lambda row: row["psnr_truth"])
                   + plane(rows, field, "the benchmark",
                           lambda row: row["psnr_benchmark"] if math.isfinite(row["quantile"]) else math.nan)
                   for field in fields_of(rows))


def focus_plots(rows):
    text = ""
    for field in fields_of(rows):
        kinds = [(mode, at_quantiles(rows, field, mode)) for mode in ("frame", "block", "blur")]
        kinds += [(f"block, {views} views", at_quantiles(rows, field, "block", 1, views)) for views in (9, 5)]
        for title, label, key, settings in (("PSNR against the benchmark", "PSNR, dB", "psnr_benchmark", ""),
                                            ("time", "ms", "ms", "set logscale y\n")):
            text += draw(f"{field}: {title}", ("disparity in focus, d_t", label),
                         [(name, points_of(some, "focus", key)) for name, some in kinds], settings)
    return text


def growth_plots(rows):
    text = ""
    # A blur radius of 0 is drawn at 0.5, because the axis is logarithmic.
    for study, title, label, start, value in (
            ("radius", "Time against the largest blur radius (0 drawn at 0.5)", "r_max, pixels", 4,
             lambda row: max(0.5, row["r_max"])),
            ("pixels", "Time against the size, r_max 8, 5 views", "megapixels", 0.45,
             lambda row: row["width"] * row["height"] / 1e6)):
        curves = []
        for mode in ("frame", "block", "blur"):
            points = points_of([row for row in rows if row["study"] == study and row["mode"] == mode], value, "ms")
            slope = log_slope([point for point in points if point[0] >= start])
            curves.append((f"{mode}, slope {fixed(slope, 2)}", points))
        text += draw(title, (label, "ms"), curves, "set logscale xy\n",
                     f"Slopes from {start:.2f} on: {'; '.join(name for name, _ in curves)}.")
    return text or "<p>Not measured.</p>"


def layer_plot(rows):
    script = ("set terminal svg size 640,430 dynamic font 'sans-serif,13' name 'layers'\n"
              "set encoding utf8\nset style data histogram\nset style histogram rowstacked\n"
              "set style fill solid 0.8\nset boxwidth 0.7\nset yrange [0:100]\nset ylabel 'share, %'\n"
              "set key outside bottom horizontal\nset xtics rotate by -30\n"
              "set title 'Shares of the layers, time (t) and pixels (p), aperture 1'\n$data << END\n")
    for field, kind in itertools.product(fields_of(rows), ("time", "pixel")):
        shares = [mean(at_quantiles(rows, field, "block"), f"{kind}_share_layer_{layer}") for layer in LAYERS]
        script += " ".join([f"{field}-{kind[0]}"] + [fixed(100 * share, 1) for share in shares]) + "\n"
    return figure(script + "END\nplot for [i=2:4] $data using i:xtic(1) title 'L = '.(i-2)\n", "")


def about(rows):
    row = next((row for row in rows if row["study"] == "main"), rows[0])
    machine = f"starfocus {row['version']}, {row['compiler']}, {row['cpu']}, best SIMD target {row['simd_target']}"
    missing = "".join(" " + name for name, program in RIVALS.items() if not shutil.which(program))
    return (f"<p>{html.escape(machine, False)}, one worker but where it says otherwise. Times are processor time, medians "
            "of interleaved repetitions inside <code>starfocus_refocus</code>; PSNR is over all R, G, B samples, at most "
            "99 dB. What is the paper's is grey and was measured on its 3.4 GHz CPU with its own light fields: compare "
            "ratios, not times.</p>\n"
            + (f"<p>Rivals left out because they are not installed:{missing}.</p>\n" if missing else ""))


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        rows = [{key: math.nan if value is None else value for key, value in row.items()} for row in json.load(file)]
    parts = (("Averages over the focus values", table_four), ("Time and error", plane_plots), ("Scales of N", scale_table),
             ("Against ray-traced truth, with rivals", truth_table),
             ("Along the focus (the paper's Figs. 22 and 23), aperture 1", focus_plots), ("Growth", growth_plots),
             ("Layers of block mode", layer_plot), ("Throughput", table_two), ("SIMD targets", target_table),
             ("Workers", worker_table), ("Instructions per pixel", lambda _: count_table(*sys.argv[2:4])))
    page = HEAD + about(rows) + "".join(f"<h2>{title}</h2>\n{make(rows)}" for title, make in parts)
    sys.stdout.buffer.write((page + "</body></html>\n").encode())


if __name__ == "__main__":
    main()
