// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/input/describe.h"

#include <utility>

namespace starfocus {

Json Describe(const Capture& capture) {
  const LightField& light_field = capture.light_field;
  Json json;
  json.Set("format", capture.format);
  Json facts;
  for (const auto& fact : capture.facts) facts.Set(fact.first, fact.second);
  if (!capture.facts.empty()) json.Set("facts", std::move(facts));
  if (capture.widest > 0) json.Set("widest_f_stop", capture.widest);
  json.Set("width", light_field.views[0].width);
  json.Set("height", light_field.views[0].height);
  json.Set("views", light_field.views.size());
  Json positions;
  for (const starfocus_position& at : light_field.positions) {
    positions.Add(Json::Array({at.u, at.v}));
  }
  json.Set("positions", std::move(positions));
  return json;
}

}  // namespace starfocus
