// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/lens_keys.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <sstream>

#include "examples/cli/input.h"
#include "examples/cli/refocus_plan.h"
#include "platform/file.h"
#include "platform/problem.h"
#include "platform/text.h"

namespace starfocus {
namespace {

constexpr char kFocusForm[] = "FRAME:at=X,Y, FRAME:track=X,Y, FRAME:track or FRAME:disparity=D";
constexpr char kApertureForm[] = "FRAME:f-stop=N, FRAME:aperture=U or FRAME:strength=S";
constexpr size_t kMostDigits = 9;  // of a number of a frame

// A key as typed: FRAME:NAME=VALUE, or FRAME:NAME with an empty value.
struct TypedKey {
  size_t frame = 0;
  std::string name, value, text;
};

// Returns nullopt if the text is not a key.
std::optional<TypedKey> ParseKey(const std::string& text) {
  const size_t colon = text.find(':'), equal = std::min(text.find('='), text.size());
  if (colon == text.npos || equal < colon || colon > kMostDigits) return {};
  const std::string frame = text.substr(0, colon);
  if (frame.empty() || frame.find_first_not_of("0123456789") != frame.npos) return {};
  return TypedKey{static_cast<size_t>(std::strtoull(frame.c_str(), nullptr, 10)),
                  text.substr(colon + 1, equal - colon - 1),
                  text.substr(std::min(equal + 1, text.size())), text};
}

// Reads the words of the value of an option: of the text itself if it begins like a key, or of the
// file of this name. Calls `take` for each key; it returns false if the key has a wrong value.
Error ReadKeys(const char* option, const char* form, const std::string& option_value,
               const std::function<bool(const TypedKey&)>& take) {
  if (option_value.empty()) return {};
  const size_t digits = option_value.find_first_not_of("0123456789 \t\n");
  const bool is_text = digits > 0 && digits != option_value.npos && option_value[digits] == ':';
  std::string text = option_value;
  if (!is_text) {
    const Result<Bytes> file = ReadSmallFile(option_value);
    if (!file) return file.error();
    text.assign(file->begin(), file->end());
  }
  const auto wrong = [&](const std::string& expected, const std::string& found) {
    return is_text ? Error::Usage(option, expected, found)
                   : Expected(option_value, expected, found);
  };
  std::istringstream words(text);
  std::string word;
  std::optional<TypedKey> last;
  while (words >> word) {
    const std::optional<TypedKey> key = ParseKey(word);
    if (!key || !take(*key)) {
      return wrong(std::string("keys ") + form, "'" + word.substr(0, 60) + "'");
    }
    if (last && key->frame <= last->frame) {
      return wrong("keys of increasing frames", last->text + " before " + key->text);
    }
    last = key;
  }
  return last ? Error() : wrong("at least one key", "none");
}

// Returns the value of a frame between keys at frames `frames` with values `values`.
double Interpolate(const std::vector<size_t>& frames, const std::vector<double>& values,
                   Easing easing, size_t frame) {
  const auto next =
      static_cast<size_t>(std::upper_bound(frames.begin(), frames.end(), frame) - frames.begin());
  if (next == 0) return values.front();
  if (next == frames.size()) return values.back();
  const double part = static_cast<double>(frame - frames[next - 1]) /
                      static_cast<double>(frames[next] - frames[next - 1]);
  const double eased = easing == Easing::kSmooth ? part * part * (3 - 2 * part) : part;
  const double from = values[next - 1], to = values[next];
  // Rounding errors must not exceed the values of the keys, for which memory is reserved.
  return std::clamp(from + eased * (to - from), std::min(from, to), std::max(from, to));
}

template <class Key>
double ValueAt(const std::vector<Key>& keys, double Key::*value, Easing easing, size_t frame) {
  std::vector<size_t> frames;
  std::vector<double> values;
  for (const Key& key : keys) {
    frames.push_back(key.frame);
    values.push_back(key.*value);
  }
  return Interpolate(frames, values, easing, frame);
}

}  // namespace

void AddLensKeyOptions(Command* command, LensKeyOptions* options) {
  AddOptions(
      {
          {"--focus-keys", "KEYS",
           "Focus of some frames, counted from 0, as text or in a file, with spaces between them: "
           "FRAME:at=X,Y or FRAME:disparity=D, or FRAME:track=X,Y to follow the subject at this "
           "pixel, which FRAME:track continues; frames between two keys have disparities between "
           "theirs; default: one focus for all frames",
           &options->focus, Use::kOptional},
          {"--aperture-keys", "KEYS",
           "Aperture of some frames, likewise: FRAME:f-stop=N, FRAME:aperture=U or "
           "FRAME:strength=S; default: one aperture for all frames",
           &options->aperture, Use::kOptional},
          {"--easing", "smooth|linear",
           "Change between two keys: smooth begins and ends slowly, linear has a constant speed",
           Choice<Easing>({{"smooth", Easing::kSmooth}, {"linear", Easing::kLinear}},
                          &options->easing),
           Use::kDefault},
      },
      command);
}

namespace {

// Adds a key of the focus. Returns false if its name or value is wrong.
bool AddFocusKey(const TypedKey& typed, std::vector<FocusKey>* keys) {
  FocusKey key;
  key.frame = typed.frame;
  key.text = typed.text;
  key.tracks = typed.name == "track";
  if (key.tracks && typed.text.back() != '=' && typed.value.empty()) {
    const auto begins = [](const FocusKey& before) { return before.tracks; };
    if (std::none_of(keys->begin(), keys->end(), begins)) return false;
  } else if (key.tracks || typed.name == "at") {
    if (!Pair(',', &key.at).read(typed.value).empty()) return false;
  } else {
    const std::optional<double> disparity = ParseNumber(typed.value);
    if (typed.name != "disparity" || !disparity) return false;
    key.disparity = *disparity;
  }
  keys->push_back(std::move(key));
  return true;
}

}  // namespace

Result<std::vector<FocusKey>> ReadFocusKeys(const std::string& option_value) {
  std::vector<FocusKey> keys;
  const Error error = ReadKeys("--focus-keys", kFocusForm, option_value,
                               [&](const TypedKey& typed) { return AddFocusKey(typed, &keys); });
  if (error) return error;
  return keys;
}

Result<std::vector<ApertureKey>> ReadApertureKeys(const std::string& option_value) {
  std::vector<ApertureKey> keys;
  const Error error =
      ReadKeys("--aperture-keys", kApertureForm, option_value, [&](const TypedKey& typed) {
        ApertureKey key;
        key.frame = typed.frame;
        key.text = typed.text;
        std::string problem = "unknown name";
        const std::optional<double> value = ParseNumber(typed.value);
        if (typed.name == "f-stop") problem = FStop(&key.options.f_stop).read(typed.value);
        if (typed.name == "aperture" && value && *value > 0 && *value <= 1) {
          key.options.aperture = value;
          problem.clear();
        }
        if (typed.name == "strength" && value && *value >= 0 && *value <= 100) {
          key.options.strength = value;
          problem.clear();
        }
        keys.push_back(std::move(key));
        return problem.empty();
      });
  if (error) return error;
  return keys;
}

void SetDisparity(double disparity, size_t key, std::vector<FocusKey>* keys) {
  (*keys)[key].disparity = disparity;
  if (!(*keys)[key].tracks) return;
  for (size_t k = key + 1; k < keys->size(); ++k) {
    if (!(*keys)[k].tracks) continue;
    if ((*keys)[k].at) return;
    (*keys)[k].disparity = disparity;
  }
}

namespace {

// Returns the first frame after those whose focus depends on the subject of a key.
size_t EndOfSubject(const std::vector<FocusKey>& keys, size_t key) {
  size_t last = key;
  for (size_t k = key + 1; k < keys.size() && !(keys[k].tracks && keys[k].at); ++k) {
    if (keys[k].tracks) last = k;
  }
  return last + 1 < keys.size() ? keys[last + 1].frame : SIZE_MAX;
}

}  // namespace

Error FollowSubjects(const std::string& where, size_t frame, starfocus_stabiliser* stabiliser,
                     DisparityRange range, const LightField* own, std::vector<FocusKey>* keys) {
  for (size_t k = 0; k < keys->size(); ++k) {
    FocusKey& key = (*keys)[k];
    if (!key.tracks || !key.at || frame < key.frame || frame >= EndOfSubject(*keys, k)) continue;
    const bool was_lost = key.subject.lost > 0;
    const starfocus_status status =
        frame == key.frame ? starfocus_track_begin(stabiliser, key.at->x, key.at->y, &key.subject)
                           : starfocus_track_focus(stabiliser, &key.subject);
    if (status != STARFOCUS_OK) {
      const starfocus_problem* const problem = starfocus_stabiliser_problem(stabiliser);
      return Error::Internal(where, "a subject that can be followed",
                             Describe(status, problem).text);
    }
    std::optional<double> focus = key.subject.focus;
    if (own != nullptr) {
      const Pixel at = {key.subject.x, key.subject.y};
      if (key.subject.lost == 0) {
        const Error error =
            FocusOfPixel("--focus-keys", at, own->width(), own->height(), own->disparity)
                .MoveTo(&focus);
        if (error) return error;
      }
      if (key.subject.lost > 0 || !focus) focus = key.disparity;
    }
    SetDisparity(std::clamp(*focus, double(range.min), double(range.max)), k, keys);
    const std::string subject = "the subject of " + key.text + " is ";
    if (!was_lost && key.subject.lost > 0)
      TellNote(where, subject + "lost; its last focus is kept");
    if (was_lost && key.subject.lost == 0) TellNote(where, subject + "found again");
  }
  return {};
}

Error CheckLastKey(const char* option, size_t frame, const std::string& text, size_t frames) {
  if (frame < frames) return {};
  return Error::Usage(option, "frames up to " + std::to_string(frames - 1), text);
}

double FocusAt(const std::vector<FocusKey>& keys, Easing easing, size_t frame) {
  return ValueAt(keys, &FocusKey::disparity, easing, frame);
}

double RadiusAt(const std::vector<ApertureKey>& keys, Easing easing, size_t frame) {
  return ValueAt(keys, &ApertureKey::radius, easing, frame);
}

}  // namespace starfocus
