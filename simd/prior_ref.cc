// SPDX-License-Identifier: Apache-2.0
#include "simd/prior.h"

namespace starfocus::simd::reference {
namespace {

void Lessen(const uint8_t* from, int way, size_t places, uint8_t* prior) {
  for (size_t l = 0; l < places; ++l) {
    if (from[l] + way < prior[l]) prior[l] = static_cast<uint8_t>(from[l] + way);
  }
}

}  // namespace

void SpreadPrior(const PriorRow& row) {
  const auto places = static_cast<ptrdiff_t>(row.places);
  for (size_t k = 0; k < row.count; ++k) {
    const ptrdiff_t at = static_cast<ptrdiff_t>(k) * row.step * places, next = row.step * places;
    uint8_t* prior = row.prior + at;
    if (k > 0) Lessen(prior - next, kBesideCost, row.places, prior);
    if (row.before == nullptr) continue;
    const uint8_t* before = row.before + at;
    Lessen(before, kBesideCost, row.places, prior);
    if (k > 0) Lessen(before - next, kDiagonalCost, row.places, prior);
    if (k + 1 < row.count) Lessen(before + next, kDiagonalCost, row.places, prior);
  }
}

void AddPrior(const uint8_t* prior, size_t count, uint8_t* cost) {
  for (size_t n = 0; n < count; ++n) {
    const int sum = cost[n] + prior[n];
    cost[n] = static_cast<uint8_t>(sum < 255 ? sum : 255);
  }
}

}  // namespace starfocus::simd::reference
