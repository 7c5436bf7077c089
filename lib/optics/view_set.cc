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

// Rates how well a view sees behind edges on a side.
struct Rating {
  int32_t along, across;  // distance of the view along the side's axis, and distance from this axis
  ViewPosition at;

  bool Helps() const { return across < kTooFarBeside * along; }
  // True if the view lies closer to the direction of this side than to the direction of any other
  // side.
  bool Own() const { return across < along; }
  // Returns twice the distance of the view along the axis of the side, minus its distance from this
  // axis.
  int32_t Merit() const { return 2 * along - across; }

  // True if this view is better than `other`. The ranking of views does not depend on the order in
  // which they were captured.
  bool Before(const Rating& other) const {
    if (Own() != other.Own()) return Own();
    if (Merit() != other.Merit()) return Merit() > other.Merit();
    if (across != other.across) return across < other.across;
    return at.u != other.at.u ? at.u < other.at.u : at.v < other.at.v;
  }
};

Rating Rate(const ViewPosition& at, const int8_t* side) {
  return {at.u * side[0] + at.v * side[1], Abs(at.u * side[1] - at.v * side[0]), at};
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
  for (int side = 0; side < kSideCount; ++side) {
    Rating best[kOcclusionViews] = {};
    OcclusionView* const on = occlusion_views.on[side];
    for (int32_t k = 1; k < views.count; ++k) {
      Rating rating = Rate(views.at[k], kSides[side]);
      if (!rating.Helps()) continue;
      OcclusionView view = {static_cast<int8_t>(k), views.at[k]};
      for (int place = 0; place < kOcclusionViews; ++place) {
        if (on[place].view != 0 && !rating.Before(best[place])) continue;
        std::swap(rating, best[place]);
        std::swap(view, on[place]);
        if (view.view == 0) break;
      }
    }
    for (int place = 1; place < kOcclusionViews; ++place) {
      if (best[place].Own() != best[0].Own()) on[place] = {};
    }
  }
  return occlusion_views;
}

}  // namespace starfocus
