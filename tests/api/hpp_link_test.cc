// starfocus.hpp alone, without exceptions and RTTI, on the shared library.
#include <starfocus/starfocus.hpp>
#include <utility>
#include <vector>

namespace {

constexpr int kSize = 12;

// Whole picture, then the same rows streamed.
bool Run() {
  std::vector<uint8_t> picture(3 * kSize * kSize, 50), whole(picture.size()), rows(picture.size());
  std::vector<float> disparity(kSize * kSize, 0.5f);
  sf_light_field field = {};
  field.views[0] = {picture.data(), 3 * kSize};
  field.disparity = disparity.data();
  field.disparity_stride = kSize * sizeof(float);

  starfocus::Config config;
  config.width = config.height = kSize;
  config.views = 1;
  config.disparity_max = 1;
  config.streaming = 1;
  starfocus::Engine first;
  if (first.Init(config) != SF_OK || first.workspace_bytes() == 0) return false;
  starfocus::Engine engine = std::move(first);
  if (engine.get() == nullptr) return false;

  starfocus::Params params;
  params.focus = 3;
  if (engine.Refocus(params, field, whole.data(), 3 * kSize) != SF_OK) return false;
  std::vector<uint8_t> prepared(picture.size()), after(picture.size());
  if (engine.Prepare(config, field) != SF_OK) return false;
  if (engine.RefocusPrepared(params, prepared.data(), 3 * kSize) != SF_OK) return false;
  const sf_previous previous = {field, whole.data(), 3 * kSize};
  if (engine.RefocusAfter(params, field, previous, after.data(), 3 * kSize) != SF_OK) return false;
  if (prepared != whole || after != whole) return false;
  if (engine.StreamBegin(params) != SF_OK) return false;
  int32_t consumed = 0, written = 0;
  if (engine.StreamPush(field, kSize, &consumed) != SF_OK || consumed != kSize) return false;
  if (engine.StreamPull(rows.data(), 3 * kSize, kSize, &written) != SF_OK) return false;
  return written == kSize && whole == picture && rows == picture;
}

}  // namespace

int main() {
  starfocus::Config bad;
  bad.width = -1;
  starfocus::Engine engine;
  if (engine.Init(bad) != SF_ERROR_SIZE) return 1;
  return Run() ? 0 : 1;
}
