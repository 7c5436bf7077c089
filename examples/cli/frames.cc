// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/frames.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>
#include <system_error>
#include <utility>

#include "examples/cli/batch.h"
#include "examples/cli/frame_pattern.h"
#include "examples/cli/input.h"
#include "platform/file.h"
#include "platform/folder.h"
#include "platform/image_io.h"
#include "platform/natural_order.h"
#include "platform/readers/pair.h"
#include "platform/text.h"
#include "platform/writers/picture.h"

namespace starfocus {

namespace {

// Returns the path of the depth picture or matte of each frame. `path` is one file for all frames,
// a folder or a pattern with a file for each frame, or empty.
Result<std::vector<std::string>> FindPictures(const std::vector<std::string>& frames,
                                              const std::string& path, const std::string& ending) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) return PairWithFolder(frames, path, ending);
  if (IsFramePattern(path)) {
    return PairWithPattern(frames, path, ending == "depth" ? "depth picture" : ending);
  }
  return std::vector<std::string>(frames.size(), path);
}

// Prints a note if numbers are missing between those of the files of a pattern.
void TellGap(const std::string& pattern, const std::map<uint64_t, std::string>& files) {
  const uint64_t first = files.begin()->first;
  const uint64_t missing = files.rbegin()->first - first + 1 - files.size();
  if (missing == 0) return;
  uint64_t next = first;
  for (const auto& file : files) {
    if (file.first != next) break;
    ++next;
  }
  TellNote(pattern, std::to_string(missing) + (missing == 1 ? " number has" : " numbers have") +
                        " no file, the first is " + std::to_string(next) +
                        ", so the video jumps there");
}

}  // namespace

Result<std::vector<FrameSource>> FindFrames(const std::vector<std::string>& inputs,
                                            const InputOptions& options, const std::string& out,
                                            bool has_8_bits) {
  std::vector<std::string> paths = inputs;
  if (std::find(paths.begin(), paths.end(), "-") != paths.end()) {
    return Error::Usage("SRC", "one stream, or files or folders as frames", "- and others");
  }
  if (inputs.size() == 1 && IsFramePattern(inputs[0])) {
    const Result<std::map<uint64_t, std::string>> files = FindPatternFiles(inputs[0]);
    if (!files) return files.error();
    paths.clear();
    for (const auto& [number, path] : *files) paths.push_back(path);
    TellGap(inputs[0], *files);
  } else if (inputs.size() == 1) {
    Result<FoundInputs> found = FindInputs(inputs[0], true, out);
    if (!found) return found.error();
    TellSkipped(found->skipped);
    paths = std::move(found->paths);
  }
  std::vector<std::string> depths, mattes;
  Error error = FindPictures(paths, options.depth, "depth").MoveTo(&depths);
  if (!error) error = FindPictures(paths, options.matte, "matte").MoveTo(&mattes);
  if (error) return error;
  std::vector<FrameSource> frames;
  std::set<std::string> names;
  for (size_t i = 0; i < paths.size(); ++i) {
    const std::string deep = has_8_bits ? "" : DeepExtensionOf(paths[i]);
    const std::string extension = deep.empty() ? ".png" : deep;
    frames.push_back({paths[i], depths[i], mattes[i], NameOfInput(paths[i]) + extension});
    names.insert(frames[i].picture);
  }
  if (names.size() == frames.size()) return frames;
  // Inputs of different folders have equal names, so their pictures are numbered.
  for (size_t i = 0; i < frames.size(); ++i) {
    const std::string extension = LowerExtension(frames[i].picture);
    char name[40];
    std::snprintf(name, sizeof name, "frame_%04zu%s", i, extension.c_str());
    frames[i].picture = name;
  }
  return frames;
}

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

Result<MapSurvey> SurveyClip(size_t frames, const OpenMap& open) {
  MapSurvey sum, before;
  // Whether 0 and 65535 are depths influences the range of the values. A frame that is judged
  // differently from the clip is therefore opened again, and with it all frames.
  for (const MapSurvey* clip = nullptr;; clip = &before) {
    sum = {};
    First first;
    std::set<bool> judged;
    for (size_t frame = 0; frame < frames; ++frame) {
      const Result<Capture> capture = open(frame, clip);
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

namespace {

namespace fs = std::filesystem;

using Names = std::vector<std::string>;
using Numbers = std::vector<std::string>;

std::string StemOf(const std::string& path) { return fs::path(path).stem().string(); }

// Depth pictures whose names differ only in their numbers.
struct Group {
  Names names;
  std::vector<Numbers> numbers;  // of each name
};

// The depth pictures that match each frame by one rule, by the index of the frame. Frames without a
// depth picture are absent, because a folder of other names has many pairings with few matches.
struct Pairing {
  std::map<size_t, Names> matches;

  void Add(size_t frame, const std::string& depth) {
    matches[frame].push_back(depth);
    ++depths;
  }

  size_t depths = 0;  // over all frames
};

// Lists the depth pictures of a folder. Frames in the same folder are no depth pictures.
Result<Names> ListDepths(const Names& frames, const std::string& folder, const std::string& kind) {
  const Result<Names> names = ListFolder(folder);
  if (!names) return names;
  std::error_code ignored;
  std::set<fs::path> taken;
  for (const std::string& frame : frames) taken.insert(fs::weakly_canonical(frame, ignored));
  Names depths;
  for (const std::string& name : *names) {
    const fs::path path = fs::path(folder) / name;
    if (name[0] == '.' || !fs::is_regular_file(path, ignored)) continue;
    if (!HasDepthExtension(name) && !IsPictureExtension(LowerExtension(name))) continue;
    if (taken.count(fs::weakly_canonical(path, ignored)) == 0) depths.push_back(name);
  }
  if (depths.empty()) return Expected(folder, "a folder with " + kind + "s", "none");
  return depths;
}

Pairing PairByName(const Names& frames, const Names& depths, const std::string& ending) {
  DepthPictures with_ending(ending);
  std::map<std::string, Names> by_name;
  for (const std::string& depth : depths) {
    with_ending.Add(depth);
    by_name[Lower(StemOf(depth))].push_back(depth);
  }
  Pairing pairing;
  for (size_t i = 0; i < frames.size(); ++i) {
    for (const std::string& depth : with_ending.Of(fs::path(frames[i]).filename().string())) {
      pairing.Add(i, depth);
    }
    for (const std::string& depth : by_name[Lower(StemOf(frames[i]))]) pairing.Add(i, depth);
  }
  return pairing;
}

// Returns the numbers of each frame without the numbers that all frames have in common. The last
// number always remains.
std::vector<Numbers> WithoutCommon(const std::vector<Numbers>& frames) {
  std::vector<Numbers> result(frames.size());
  const size_t count = frames[0].size();
  for (size_t k = 0; k < count; ++k) {
    const bool common = std::all_of(frames.begin(), frames.end(), [&](const Numbers& numbers) {
      return numbers[k] == frames[0][k];
    });
    for (size_t i = 0; i < frames.size() && (!common || k + 1 == count); ++i) {
      result[i].push_back(frames[i][k]);
    }
  }
  return result;
}

// Pairs the frames with the depth pictures of a group that have the numbers of the frame in
// succession, from the number `first` on. `frames` has the index of the frame with given numbers.
Pairing PairByNumber(const std::map<Numbers, size_t>& frames, const Group& group, size_t first) {
  const auto count = static_cast<ptrdiff_t>(frames.begin()->first.size());
  Pairing pairing;
  for (size_t k = 0; k < group.names.size(); ++k) {
    const auto begin = group.numbers[k].begin() + static_cast<ptrdiff_t>(first);
    const auto found = frames.find(Numbers(begin, begin + count));
    if (found != frames.end()) pairing.Add(found->second, group.names[k]);
  }
  return pairing;
}

// Returns the pairings by number: of all numbers of the frames if one of them is complete,
// otherwise without the numbers that the frames have in common. Depth pictures with numbers that
// are equal in all their names, such as a version, match no frame or several frames.
std::vector<Pairing> PairByNumbers(const Names& frames, const Names& depths) {
  std::map<std::string, Group> groups;
  for (const std::string& depth : depths) {
    const NumberedName name = ParseNumberedName(StemOf(depth));
    groups[name.shape].names.push_back(depth);
    groups[name.shape].numbers.push_back(name.numbers);
  }
  std::vector<Numbers> numbers;
  for (const std::string& frame : frames) {
    numbers.push_back(ParseNumberedName(StemOf(frame)).numbers);
    if (numbers.back().empty() || numbers.back().size() != numbers[0].size()) return {};
  }
  std::vector<Pairing> pairings;
  for (const std::vector<Numbers>& keys : {numbers, WithoutCommon(numbers)}) {
    std::map<Numbers, size_t> indices;
    for (size_t i = 0; i < keys.size(); ++i) indices.emplace(keys[i], i);
    if (indices.size() < keys.size()) continue;
    const auto complete = [&](const Pairing& pairing) {
      return pairing.matches.size() == frames.size();
    };
    if (std::any_of(pairings.begin(), pairings.end(), complete)) break;
    for (const auto& [shape, group] : groups) {
      for (size_t k = 0; k + keys[0].size() <= group.numbers[0].size(); ++k) {
        pairings.push_back(PairByNumber(indices, group, k));
      }
    }
  }
  return pairings;
}

// Chooses the pairing that matches the most frames, and among these the first with the fewest depth
// pictures. Returns an error unless it matches each frame with one depth picture, and no other
// pairing does so.
Result<Names> Choose(const Names& frames, const std::string& folder, const std::string& kind,
                     const std::vector<Pairing>& pairings) {
  const auto figures = [&](const Pairing& pairing) {
    return std::pair<size_t, size_t>(frames.size() - pairing.matches.size(), pairing.depths);
  };
  const Pairing& best = *std::min_element(
      pairings.begin(), pairings.end(),
      [&](const Pairing& a, const Pairing& b) { return figures(a) < figures(b); });
  const std::string expected = "one " + kind + " with the name or number of the frame in " + folder;
  std::vector<const Pairing*> equal;  // all pairings that are as good as the best one
  for (const Pairing& pairing : pairings) {
    if (figures(pairing) == figures(best)) equal.push_back(&pairing);
  }
  Names chosen;
  for (size_t i = 0; i < frames.size(); ++i) {
    if (best.matches.count(i) == 0) {
      return Expected(frames[i], expected,
                      "none (" + std::to_string(best.matches.size()) + " of " +
                          std::to_string(frames.size()) + " frames have one)");
    }
    std::set<std::string> found;
    for (const Pairing* pairing : equal) {
      const auto names = pairing->matches.find(i);
      if (names != pairing->matches.end()) found.insert(names->second.begin(), names->second.end());
    }
    if (found.size() > 1) {
      return Expected(frames[i], expected, *found.begin() + " and " + *++found.begin());
    }
    chosen.push_back(*found.begin());
  }
  return chosen;
}

}  // namespace

Result<std::vector<std::string>> PairWithFolder(const std::vector<std::string>& frames,
                                                const std::string& folder,
                                                const std::string& ending) {
  const std::string kind = ending == "depth" ? "depth picture" : ending;
  const Result<Names> depths = ListDepths(frames, folder, kind);
  if (!depths) return depths;
  std::vector<Pairing> pairings = {PairByName(frames, *depths, ending)};
  if (pairings[0].matches.size() < frames.size()) {
    for (Pairing& pairing : PairByNumbers(frames, *depths)) pairings.push_back(std::move(pairing));
  }
  Result<Names> chosen = Choose(frames, folder, kind, pairings);
  if (!chosen) return chosen;
  const std::set<std::string> used(chosen->begin(), chosen->end());
  Names unused;
  std::copy_if(depths->begin(), depths->end(), std::back_inserter(unused),
               [&](const std::string& name) { return used.count(name) == 0; });
  if (!unused.empty()) {
    TellNote(folder, unused.size() == 1 ? "the " + kind + " " + unused[0] + " belongs to no frame"
                                        : std::to_string(unused.size()) + " " + kind +
                                              "s belong to no frame, such as " + unused[0]);
  }
  for (std::string& name : *chosen) name = (fs::path(folder) / name).string();
  return chosen;
}

}  // namespace starfocus
