// SPDX-License-Identifier: Apache-2.0
// Tests that a picture is encoded while another thread computes its rows.
#include "platform/row_gate.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <string>

#include "platform/image.h"
#include "platform/writers/picture.h"

namespace {

using starfocus::Image;
using starfocus::RowGate;

// Returns true if a result is not available after 50 ms. A correct program always passes.
template <class T>
bool IsWaiting(const std::future<T>& result) {
  return result.wait_for(std::chrono::milliseconds(50)) == std::future_status::timeout;
}

TEST_CASE("RowGate: WaitFor returns after the row is finished") {
  RowGate gate;
  auto seen = std::async(std::launch::async, [&] { gate.WaitFor(6); });
  CHECK(IsWaiting(seen));
  gate.Finish(6);
  CHECK(IsWaiting(seen));
  gate.Finish(7);
  seen.get();
  gate.Finish(2);  // finished rows stay finished
  gate.WaitFor(6);
  gate.FinishAll();
  gate.WaitFor(1 << 20);
}

TEST_CASE("EncodePicture: a row is read after it is finished") {
  Image whole(40, 33), made(40, 33);
  for (size_t k = 0; k < whole.pixels.size(); ++k) whole.pixels[k] = uint8_t(k * k / 7);
  for (const std::string path : {"a.jpg", "a.png"}) {
    CAPTURE(path);
    std::fill(made.pixels.begin(), made.pixels.end(), uint8_t{0});
    RowGate gate;
    auto encoded = std::async(std::launch::async,
                              [&] { return starfocus::EncodePicture(path, made, {}, &gate); });
    for (int y = 0; y < whole.height; ++y) {
      if (y == 0 || y == whole.height - 1) CHECK(IsWaiting(encoded));
      std::copy_n(whole.row(y), whole.stride(), made.row(y));
      gate.Finish(y + 1);
    }
    const auto expected = starfocus::EncodePicture(path, whole, {});
    CHECK(*encoded.get() == *expected);
  }
}

}  // namespace
