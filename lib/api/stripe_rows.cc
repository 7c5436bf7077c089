// SPDX-License-Identifier: Apache-2.0
#include "lib/api/stripe_rows.h"

namespace starfocus {

RowRange StripeRows(const EngineState& engine) {
  const Rect& region = engine.lens.region;
  const int32_t reach = JoinReach(engine.config, engine.lens);
  const int32_t side = engine.config.largest_block;
  return {Max(0, region.y - reach) / side * side,
          Min(engine.config.height, region.y + region.height + reach)};
}

RowRange MapRows(const EngineState& engine) {
  const RowRange stripes = StripeRows(engine);
  const int32_t side = engine.config.largest_block;
  const int32_t end = (stripes.last + side - 1) / side * side + engine.lens.reach.rows;
  return {Max(0, stripes.first - engine.lens.reach.rows), Min(engine.config.height, end)};
}

}  // namespace starfocus
