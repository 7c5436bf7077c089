// SPDX-License-Identifier: Apache-2.0
#include "lib/optics/view_set.h"

#include <utility>

#include "lib/base/problem.h"

namespace starfocus {
namespace {

constexpr int16_t kOne = kViewOne, kHalf = kViewOne / 2;
constexpr ViewPosition kStar[STARFOCUS_MAX_VIEWS] = {
    {0, 0},        {kOne, 0},      {-kOne, 0},      {0, kOne},       {0, -kOne},       {kOne, kOne},
    {-kOne, kOne}, {kOne, -kOne},  {-kOne, -kOne},  {kHalf, 0},      {-kHalf, 0},      {0, kHalf},
    {0, -kHalf},   {kHalf, kHalf}, {-kHalf, kHalf}, {kHalf, -kHalf}, {-kHalf, -kHalf},
};

bool SamePosition(const ViewPosition& a, const ViewPosition& b) { return a.u == b.u && a.v == b.v; }

bool IsStarCount(int32_t views) { return views == 1 || views == 5 || views == 9 || views == 17; }

int16_t Converted(double coordinate) {
  const double scaled = coordinate * kViewOne;
  return static_cast<int16_t>(scaled < 0 ? scaled - 0.5 : scaled + 0.5);
}

// Each side has an axis, which starts at the centre view. A view is ignored if its distance from
// this axis is at least kTooFarBeside times its distance along the axis.
constexpr int32_t kTooFarBeside = 8;

// Return the distance of a view along the axis of a side, and its distance from this axis.
int32_t Along(const ViewPosition& at, const int8_t* side) {
  return at.u * side[0] + at.v * side[1];
}
int32_t Across(const ViewPosition& at, const int8_t* side) {
  return Abs(at.u * side[1] - at.v * side[0]);
}

// Returns true if a view lies closer to the direction of a side than to that of any other side.
bool IsOwn(const ViewPosition& at, const int8_t* side) {
  return Across(at, side) < Along(at, side);
}

// Returns true if view `a` sees better behind edges on a side than view `b`. The ranking of views
// does not depend on the order in which they were captured.
bool IsBetter(const ViewPosition& a, const ViewPosition& b, const int8_t* side) {
  if (IsOwn(a, side) != IsOwn(b, side)) return IsOwn(a, side);
  const int32_t across_a = Across(a, side), across_b = Across(b, side);
  const int32_t merit_a = 2 * Along(a, side) - across_a, merit_b = 2 * Along(b, side) - across_b;
  if (merit_a != merit_b) return merit_a > merit_b;
  if (across_a != across_b) return across_a < across_b;
  return a.u != b.u ? a.u < b.u : a.v < b.v;
}

}  // namespace

ViewPosition StarPosition(int index) { return kStar[index]; }

int CapturedView(int u, int v, bool half) {
  // Indices of the captured views at full distance from the centre, indexed by u + 1 and v + 1.
  // Views at half distance have the index of the full-distance view plus 8.
  constexpr int8_t kIndex[3][3] = {{8, 2, 6}, {4, 0, 3}, {7, 1, 5}};
  const int index = kIndex[u + 1][v + 1];
  return half && index != 0 ? index + 8 : index;
}

starfocus_status FindViews(int32_t count, const starfocus_position* positions,
                           starfocus_problem* problem, ViewSet* views) {
  *views = {};
  Checker check(problem);
  check.In({"views", double(count)}, STARFOCUS_FROM_TO(1, STARFOCUS_MAX_VIEWS));
  if (check.status() != STARFOCUS_OK) return check.status();
  views->count = count;
  views->star = IsStarCount(count);
  bool given = false;
  for (int32_t k = 0; k < count; ++k) {
    const starfocus_position& position = positions[k];
    given = given || position.u != 0 || position.v != 0;
    check.In({"positions[].u", position.u, k}, STARFOCUS_FROM_TO(-1, 1));
    check.In({"positions[].v", position.v, k}, STARFOCUS_FROM_TO(-1, 1));
    if (check.status() != STARFOCUS_OK) return check.status();
    views->at[k] = {Converted(position.u), Converted(position.v)};
  }
  if (!given) {
    for (int32_t k = 0; k < count; ++k) views->at[k] = kStar[k];
    check.Need(views->star, STARFOCUS_ERROR_RANGE, {"views", double(count)},
               {"1, 5, 9 or 17 without positions"});
    return check.status();
  }
  check.Need(SamePosition(views->at[0], {0, 0}), STARFOCUS_ERROR_RANGE, {"positions[]"},
             {"(0, 0)"});
  for (int32_t k = 0; k < count; ++k) {
    views->star = views->star && SamePosition(views->at[k], kStar[k]);
    for (int32_t other = 0; other < k; ++other) {
      check.Need(!SamePosition(views->at[k], views->at[other]), STARFOCUS_ERROR_RANGE,
                 {"positions[]", kNoNumber, k},
                 {"a position that differs from all earlier positions"});
    }
  }
  return check.status();
}

bool HasStar(const FullConfig& config) {
  ViewSet views;
  return FindViews(config.views, config.positions, config.problem, &views) == STARFOCUS_OK &&
         views.star;
}

bool SameViews(const FullConfig& a, const FullConfig& b) {
  ViewSet first, second;
  FindViews(a.views, a.positions, a.problem, &first);
  FindViews(b.views, b.positions, b.problem, &second);
  bool same = first.count == second.count;
  for (int32_t k = 0; same && k < first.count; ++k) same = SamePosition(first.at[k], second.at[k]);
  return same;
}

OcclusionViews ChooseOcclusionViews(const ViewSet& views) {
  OcclusionViews occlusion_views;
  for (int index = 0; index < kSideCount; ++index) {
    const int8_t* const side = kSides[index];
    OcclusionView* const on = occlusion_views.on[index];
    for (int32_t k = 1; k < views.count; ++k) {
      OcclusionView view = {static_cast<int8_t>(k), views.at[k]};
      if (Across(view.at, side) >= kTooFarBeside * Along(view.at, side)) continue;
      for (int place = 0; place < kOcclusionViews && view.view != 0; ++place) {
        if (on[place].view == 0 || IsBetter(view.at, on[place].at, side)) {
          std::swap(view, on[place]);
        }
      }
    }
    for (int place = 1; place < kOcclusionViews; ++place) {
      if (IsOwn(on[place].at, side) != IsOwn(on[0].at, side)) on[place] = {};
    }
  }
  return occlusion_views;
}

}  // namespace starfocus
