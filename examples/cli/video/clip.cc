// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/video/clip.h"

#include <set>
#include <utility>

#include "examples/cli/input/input.h"
#include "platform/image_io.h"
#include "platform/text.h"

namespace starfocus {
namespace {

// Size of the first frame and kind of its map, which all frames must have.
struct First {
  std::string size, kind_path;
};

Error CheckFrame(const Capture& capture, const MapSurvey& sum, First* first) {
  Image centre;
  const bool is_loaded = !capture.light_field.views.empty();
  if (!is_loaded) {
    if (Error error = ReadImage(capture.files[0].path).MoveTo(&centre)) return error;
  }
  const Image& view = is_loaded ? capture.light_field.views[0] : centre;
  const std::string size = SizeText(view.width, view.height);
  if (first->size.empty()) first->size = size;
  if (size != first->size) {
    return Expected(capture.path, first->size + " pixels, the size of the first frame", size);
  }
  const std::string& kind = capture.survey.kind;
  if (kind.empty()) return {};
  if (sum.kind.empty()) first->kind_path = capture.path;
  if (sum.kind.empty() || kind == sum.kind) return {};
  return Expected(capture.path, sum.kind + " as in " + first->kind_path, kind);
}

}  // namespace

InputOptions OptionsOf(const InputOptions& options, const FrameSource& frame) {
  InputOptions one = options;
  one.path = frame.path;
  one.depth = frame.depth;
  one.matte = frame.matte;
  one.map.is_frame = true;
  return one;
}

Result<MapSurvey> SurveyClip(const std::vector<FrameSource>& frames, const InputOptions& options) {
  MapSurvey sum, before;
  // Whether 0 and 65535 are depths influences the range of the values. A frame that is judged
  // differently from the clip is therefore opened again, and with it all frames.
  for (const MapSurvey* clip = nullptr;; clip = &before) {
    sum = {};
    First first;
    std::set<bool> judged;
    for (const FrameSource& frame : frames) {
      InputOptions one = OptionsOf(options, frame);
      one.map.clip = clip;
      const Result<Capture> capture = ReadInput(one);
      if (!capture) return capture.error();
      if (Error error = CheckFrame(*capture, sum, &first)) return error;
      const MapEnds& ends = capture->survey.ends;
      if (ends.zeros + ends.negatives + ends.tops > 0) judged.insert(ends.AreDepths());
      sum.Add(capture->survey);
    }
    judged.insert(sum.ends.AreDepths());
    const size_t at_ends = sum.ends.zeros + sum.ends.negatives + sum.ends.tops;
    if (clip != nullptr || at_ends == 0 || judged.size() == 1) return sum;
    before = std::move(sum);
  }
}

}  // namespace starfocus
