// SPDX-License-Identifier: Apache-2.0
// Focus and aperture of the frames of a video, which --focus-keys and --aperture-keys set at some
// frames, the keys. Between two keys, the disparity in focus and the radius of the aperture are
// interpolated, so that a focus pull passes through all depths. Frames before the first key and
// after the last key have the values of these keys. The disparity of a key that follows a subject
// changes from frame to frame.
#ifndef STARFOCUS_EXAMPLES_CLI_LENS_KEYS_H_
#define STARFOCUS_EXAMPLES_CLI_LENS_KEYS_H_

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "examples/cli/estimate_run.h"
#include "examples/cli/lens_options.h"
#include "examples/command_line/command.h"
#include "examples/command_line/options.h"
#include "platform/light_field.h"
#include "platform/result.h"
#include "starfocus/video.h"

namespace starfocus {

enum class Easing { kSmooth, kLinear };

// Options of the command line. The keys are a text or the name of a file.
struct LensKeyOptions {
  std::string focus, aperture;
  Easing easing = Easing::kSmooth;
};

void AddLensKeyOptions(Command* command, LensKeyOptions* options);

struct FocusKey {
  size_t frame = 0;
  std::optional<Pixel> at;  // pixel whose surface is in focus
  // True: the focus follows the subject at the pixel `at` or, without it, that of an earlier key.
  bool tracks = false;
  double disparity = 0;          // for a pixel, found in the map of the frame
  std::string text;              // the key as typed
  starfocus_track subject = {};  // with `tracks` and `at`, from the frame on
};

struct ApertureKey {
  size_t frame = 0;
  ApertureOptions options;  // with one value
  double radius = 0;        // found from the options and the lens of the input
  std::string text;
};

// Read the keys of an option; without keys, the result is empty. Return an error unless each key
// can be read and the frames increase.
Result<std::vector<FocusKey>> ReadFocusKeys(const std::string& option_value);
Result<std::vector<ApertureKey>> ReadApertureKeys(const std::string& option_value);

// Returns an error of the option if the last key is not a frame of a video of `frames` frames.
Error CheckLastKey(const char* option, size_t frame, const std::string& text, size_t frames);

// Sets the disparity of a key, and of later keys that follow its subject.
void SetDisparity(double disparity, size_t key, std::vector<FocusKey>* keys);

// Follows the subjects to a frame, which must be the next one and the last of the stabiliser. Sets
// the disparities of their keys, within `range`, from the stabilised map or, if it is not null,
// from the map of `own`, which the picture gets. Prints a note, which begins with `where`, when a
// subject is lost or found again.
Error FollowSubjects(const std::string& where, size_t frame, starfocus_stabiliser* stabiliser,
                     DisparityRange range, const LightField* own, std::vector<FocusKey>* keys);

// Return the value of a frame. There must be a key.
double FocusAt(const std::vector<FocusKey>& keys, Easing easing, size_t frame);
double RadiusAt(const std::vector<ApertureKey>& keys, Easing easing, size_t frame);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_LENS_KEYS_H_
