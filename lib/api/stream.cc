// SPDX-License-Identifier: Apache-2.0
// C API: streams. The caller pushes input rows, which are stored in ring buffers, and pulls
// finished rows.
#include "lib/api/validate.h"
#include "lib/engine/engine.h"
#include "lib/engine/stripe.h"
#include "lib/io/output.h"

namespace starfocus {
namespace {

// Returns the total number of input rows that must be pushed before the next stripe can be
// refocused.
int32_t NeededRows(const EngineState& engine) {
  return Min(engine.config.height, engine.stream.next + engine.config.superblock +
                                       LargestBorders(engine.config).streamed);
}

void CheckCount(const EngineState& engine, int32_t rows, const Allowed& allowed, Checker* check) {
  check->Need(engine.stream.active, STARFOCUS_ERROR_STATE, {"stream"},
              {"an earlier call of starfocus_stream_begin"});
  check->In({"rows", double(rows)}, allowed);
}

// Checks the number of rows of a push or pull that starts at row `first`. Formats with chroma of
// two rows require pairs of rows.
void CheckPairs(const FullConfig& config, bool is_yuv, int32_t first, int32_t rows,
                Checker* check) {
  const bool are_pairs = first % 2 == 0 && (rows % 2 == 0 || first + rows == config.height);
  check->Need(!is_yuv || rows == 0 || are_pairs, STARFOCUS_ERROR_RANGE, {"rows", double(rows)},
              {"even, except at the end of the picture"});
}

bool AnyYuv(const FullConfig& config, const starfocus_light_field& light_field) {
  for (int view = 0; view < config.views; ++view) {
    if (HasRowPairs(light_field.views[view].format)) return true;
  }
  return false;
}

// Copies `rows` of a light field to the rings, unless a value of the map is invalid.
starfocus_status PushUnit(const Input& from, const Range& rows, EngineState* engine) {
  uint64_t unknown = 0;
  for (int32_t y = rows.first; y < rows.last; ++y) {
    const uint32_t flags = ReadMap(from, {y, y + 1}, &engine->rings.disparity, &unknown);
    const starfocus_status status = CheckFlags(flags, engine->config);
    if (status != STARFOCUS_OK) return status;
  }
  CopyRows(from, rows, engine->rings);
  engine->report.unknown_pixels += unknown;
  return STARFOCUS_OK;
}

// Copies up to `rows` rows of a light field, `unit` (1 or 2) at a time, until all input rows of the
// next stripe are stored. Adds the number of copied rows to *consumed.
starfocus_status PushRows(const Input& from, int32_t rows, int32_t unit, EngineState* engine,
                          int32_t* consumed) {
  Stream& stream = engine->stream;
  const InputRings& rings = engine->rings;
  const bool covers = from.given_coverage.data != nullptr;
  if (stream.pushed == 0) {
    stream.covers = covers;
    StoredViews views;
    views.tables = rings.tables;
    for (int view = 0; view < engine->config.views; ++view) {
      if (rings.tables == nullptr) views.codes[view] = rings.View(view);
      views.deep[view] = rings.deep[view];
      views.deep_alpha[view] = rings.deep_alpha[view];
    }
    engine->input = InputOf(engine->config, *engine->kernels, views, rings.disparity,
                            covers ? rings.coverage : Plane<uint8_t>());
  }
  Checker check(engine->config.problem);
  check.Need(covers == stream.covers, STARFOCUS_ERROR_STATE, {"coverage"},
             {"in all rows or in none"});
  if (check.status() != STARFOCUS_OK) return check.status();
  while (*consumed < rows && stream.pushed < NeededRows(*engine)) {
    const int32_t some = Min(unit, rows - *consumed);
    const starfocus_status status = PushUnit(from, {stream.pushed, stream.pushed + some}, engine);
    if (status != STARFOCUS_OK) return status;
    stream.pushed += some;
    *consumed += some;
  }
  return STARFOCUS_OK;
}

// Writes up to `rows` finished rows to `out`, but at most up to row `end`. Adds the number of
// written rows to *written.
starfocus_status StoreFinished(const Output& out, int32_t end, EngineState* engine,
                               int32_t* written) {
  Stream& stream = engine->stream;
  const Range rows = {stream.written, Min(stream.finished, end)};
  if (rows.first >= rows.last) return STARFOCUS_OK;
  const starfocus_status status =
      StoreRows(out, rows, BufferRows(*engine, stream.next - engine->config.superblock),
                MaxJobs(engine->config), engine->jobs);
  if (status != STARFOCUS_OK) return status;
  stream.written = rows.last;
  *written += rows.last - rows.first;
  return STARFOCUS_OK;
}

// Writes up to `rows` finished rows to `out`. Refocuses the stripes of these rows if their input
// rows have been pushed. Adds the number of written rows to *written.
starfocus_status PullRows(const Output& out, int32_t rows, EngineState* engine, int32_t* written) {
  const FullConfig& config = engine->config;
  Stream& stream = engine->stream;
  CallProgress& call_progress = engine->jobs->call_progress;
  // Ends the cancellation of an earlier pull, also for rows that this pull only stores.
  call_progress.Begin(stream.finished, config.height);
  const int32_t end = stream.written + rows;
  const starfocus_status status = StoreFinished(out, end, engine, written);
  if (status != STARFOCUS_OK) return status;
  // A stripe finishes the last kDeblockRows rows above it.
  const Range stripes = {
      stream.next, stream.finished < end ? Min(config.height, end + kDeblockRows) : stream.next};
  const int32_t reach = LargestBorders(config).streamed;
  return ForStripes(stripes, reach, stream.pushed, config, [&](int32_t y, const Range&) {
    const starfocus_status refocused = RefocusStripe(engine, y);
    if (refocused != STARFOCUS_OK) return refocused;
    stream.finished = FinishedRows(config, y);
    stream.next += config.superblock;
    call_progress.SetRows(stream.finished);
    if (!call_progress.Ask()) return STARFOCUS_ERROR_CANCELLED;
    return StoreFinished(out, end, engine, written);
  });
}

}  // namespace
}  // namespace starfocus

using namespace starfocus;

starfocus_status starfocus_stream_begin(starfocus_engine* engine, const starfocus_params* params) {
  FullParams full;
  Checker check = Enter(engine);
  check.NotNull(params, "params");
  ReadParams(params, &full, &check);
  if (!check.passed()) return check.status();
  EngineState& e = *reinterpret_cast<EngineState*>(engine);
  CheckParams(e.config, full, &check);
  check.Need(Has(e.config, STARFOCUS_FEATURE_STREAMING), STARFOCUS_ERROR_FEATURE,
             {"features", double(e.config.features)}, {"STARFOCUS_FEATURE_STREAMING"});
  check.Need(IsWhole(full.region), STARFOCUS_ERROR_RANGE, {"region"}, {"all 0"});
  check.Need(full.preview_shift == 0, STARFOCUS_ERROR_RANGE, {"preview_shift"}, {"0 for a stream"});
  check.Need(full.previous == nullptr, STARFOCUS_ERROR_RANGE, {"previous"}, {"null for a stream"});
  if (!check.passed()) return check.status();
  e.stream = Stream();
  e.jobs->call_progress.Begin(0, e.config.height);
  if (check.Add(SetLens(full, &e)) != STARFOCUS_OK) return check.status();
  e.stream.active = true;
  return STARFOCUS_OK;
}

starfocus_status starfocus_stream_push(starfocus_engine* engine,
                                       const starfocus_light_field* light_field, int32_t rows,
                                       int32_t* consumed) {
  if (consumed != nullptr) *consumed = 0;
  Checker check = Enter(engine);
  check.NotNull(light_field, "light_field");
  check.NotNull(consumed, "consumed");
  if (!check.passed()) return check.status();
  EngineState& e = *reinterpret_cast<EngineState*>(engine);
  starfocus_light_field field = {};
  check.Read(*light_field, "light_field.size", &field);
  CheckCount(e, rows,
             {"0 to the number of remaining rows", 0, double(e.config.height - e.stream.pushed)},
             &check);
  CheckLightField(e.config, field, &check);
  if (!check.passed()) return check.status();
  CheckPairs(e.config, AnyYuv(e.config, field), e.stream.pushed, rows, &check);
  if (!check.passed()) return check.status();
  const Input from = InputOf(e.config, *e.kernels, field, e.stream.pushed, &e.rings);
  const int32_t unit = AnyYuv(e.config, field) ? 2 : 1;
  starfocus_depth_map map = field.depth;
  int32_t first = 0;
  if (map.height == e.config.height) {  // The map begins at the next row of the stream.
    first = e.stream.pushed;
    map.height = rows;
  }
  const starfocus_status status = PushRows(from, rows, unit, &e, consumed);
  return TellPlace(status, map, first, &e.problem);
}

starfocus_status starfocus_stream_pull(starfocus_engine* engine, const starfocus_image* out,
                                       int32_t rows, int32_t* written, starfocus_report* report) {
  if (written != nullptr) *written = 0;
  Checker check = Enter(engine);
  check.NotNull(out, "out");
  check.NotNull(written, "written");
  CheckReport(report, &check);
  if (!check.passed()) return check.status();
  EngineState& e = *reinterpret_cast<EngineState*>(engine);
  CheckCount(e, rows, {"at least 0", 0, INT32_MAX}, &check);
  const int32_t first = e.stream.written, left = e.config.height - first;
  const int32_t most = Min(rows, left);
  CheckOutput(e.config, *out, e.config.width, e.config.height, &check);
  CheckPairs(e.config, HasRowPairs(out->format), first, most, &check);
  if (check.passed() && most > 0) {
    Extents memory;
    memory.Add(Workspace(e));
    CheckOutputApart(*out, e.config.width, most, memory, &check);
  }
  if (!check.passed()) return check.status();
  const Plane<uint8_t>& alpha = e.rings.alpha;
  Output output = OutputOf(e, *out, {0, first, e.config.width, left});
  output.alpha = {alpha.data, alpha.stride, alpha.rows, 0};
  check.Add(PullRows(output, most, &e, written));
  if (check.passed()) WriteReport(e, report);
  return check.status();
}
