// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/apple_mattes.h"

#include <algorithm>
#include <set>
#include <utility>

#include "platform/readers/matte.h"
#include "platform/readers/photo_scale.h"

namespace starfocus {
namespace {

using Names = std::set<std::string>;

constexpr char kWhole[] = "portrait effects";

// Returns the name in the type of a matte, for example "hair", or an empty string if `type` is not
// the type of a matte.
std::string NameOf(const std::string& type) {
  const std::string matte = "matte", semantic = "semantic";
  std::string name = type.substr(type.rfind(':') + 1);
  const size_t at = name.find(matte);
  if (at == std::string::npos) return "";
  name.erase(at, matte.size());
  if (name == "portraiteffects") return kWhole;
  return name.rfind(semantic, 0) == 0 ? name.substr(semantic.size()) : name;
}

std::string Listed(const Names& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

// Sets each sample of `matte` to the maximum of `matte` and `part`. Accepts an empty `matte`.
void Unite(FloatMap part, FloatMap* matte) {
  if (matte->values.empty()) std::swap(part, *matte);
  if (part.values.empty()) return;
  const FloatMap fitted = Resize(part, matte->width, matte->height);
  for (size_t k = 0; k < fitted.values.size(); ++k) {
    matte->values[k] = std::max(matte->values[k], fitted.values[k]);
  }
}

// Adds a note about a matte. If the photo has no depth, the note is the reason.
void Ignore(const Error& error, DepthPhoto* photo) {
  photo->matte_notes.push_back(error.line());
  if (photo->map_problem.empty()) photo->map_problem = error.line();
}

// Returns the maximum of the mattes with the names `wanted`. Removes the names of mattes that the
// file does not have, or that cannot be decoded, from `wanted`.
FloatMap Join(const std::vector<AuxiliaryPicture>& pictures, Names* wanted, DepthPhoto* photo) {
  FloatMap joined;
  Names used;
  for (const AuxiliaryPicture& picture : pictures) {
    const std::string name = NameOf(picture.type);
    if (wanted->count(name) == 0) continue;
    Result<FloatMap> part = picture.decode("the " + name + " matte in the file is ignored");
    if (part) {
      Unite(std::move(*part), &joined);
      used.insert(name);
    } else {
      Ignore(part.error(), photo);
    }
  }
  *wanted = std::move(used);
  return joined;
}

// Sets photo->matte to the maximum of the mattes with the names `wanted`. Returns the names of the
// mattes that are used. The result is empty if none of the mattes is usable.
Names Take(const std::vector<AuxiliaryPicture>& pictures, Names wanted, DepthPhoto* photo) {
  FloatMap matte = Join(pictures, &wanted, photo);
  if (wanted.empty()) return {};
  const std::string names = Listed(wanted);
  const std::string where = "the " + names + " matte in the file is ignored";
  if (Error error = CheckMatte(where, matte, photo->picture, false)) {
    Ignore(error, photo);
    return {};
  }
  photo->matte = std::move(matte);
  return wanted;
}

}  // namespace

void ChooseMatte(const std::vector<AuxiliaryPicture>& pictures, DepthPhoto* photo) {
  Names used = Take(pictures, {kWhole}, photo);
  if (used.empty()) {
    used = Take(pictures, {"hair", "skin", "teeth", "glasses"}, photo);
    if (!used.empty()) {
      photo->matte_notes.push_back("the matte of the subject contains only " + Listed(used) +
                                   ", because the file has no usable portrait effects matte");
    }
  }
  Names others;
  for (const AuxiliaryPicture& picture : pictures) {
    const std::string name = NameOf(picture.type);
    if (!name.empty() && used.count(name) == 0) others.insert(name);
  }
  std::string all = Listed(used);
  if (!others.empty()) all += (all.empty() ? "ignored: " : "; ignored: ") + Listed(others);
  if (!all.empty()) photo->facts.emplace_back("mattes", all);
}

}  // namespace starfocus
