// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/confined_photo.h"

#include "platform/helper/helper.h"
#include "platform/readers/heic.h"

namespace starfocus {

void Pass(Channel* channel, DepthPhoto* photo) {
  // The structured binding fails to compile if DepthPhoto gets another field. A helper process must
  // not choose files, so that no path is passed. Helpers do not apply the orientation. `survey` has
  // no figures before the map is complete.
  auto& [format, picture, deep, deep_colours, map, map_problem, unused_path, gain_map, matte,
         is_mask, unused_matte_path, matte_notes, right, unused_right_path, meaning, guesses_near,
         unused_survey, orientation, unused_applied_orientation, focal_35mm, is_blurred, has_focus,
         focus_x, focus_y, has_subject, subject_x, subject_y, is_ready, is_linear, focus_value,
         metadata, facts, notes, lost] = *photo;
  for (Image* image : {&picture, &right}) Pass(channel, image);
  Pass(channel, &deep);
  Pass(channel, &deep_colours);
  for (FloatMap* values : {&map, &matte}) Pass(channel, values);
  Pass(channel, &gain_map);
  Pass(channel, &metadata);
  static_cast<void>(unused_path);
  static_cast<void>(unused_matte_path);
  static_cast<void>(unused_right_path);
  static_cast<void>(unused_survey);
  static_cast<void>(unused_applied_orientation);
  for (std::string* text : {&format, &map_problem}) channel->Text(text);
  for (bool* value :
       {&is_mask, &guesses_near, &is_blurred, &has_focus, &has_subject, &is_ready, &is_linear})
    channel->Value(value);
  for (double* value : {&focus_x, &focus_y, &subject_x, &subject_y}) {
    channel->Value(value);
    channel->Require(*value >= 0 && *value <= 1);
  }
  for (double* value : {&focal_35mm, &focus_value}) channel->Value(value);
  channel->Require(focal_35mm >= 0 && focal_35mm <= 65535);
  channel->Value(&meaning);
  channel->Value(&orientation);
  channel->Require(meaning >= MapMeaning::kInverseMetres && meaning <= MapMeaning::kDisparity);
  channel->Require(orientation >= 1 && orientation <= 8);
  channel->List(&facts, [&](Facts::value_type* fact) {
    channel->Text(&fact->first);
    channel->Text(&fact->second);
  });
  for (std::vector<std::string>* list : {&matte_notes, &notes, &lost}) {
    channel->List(list, [&](std::string* note) { channel->Text(note); });
  }
}

Result<DepthPhoto> ConfinedPhoto(const std::string& where, Span file,
                                 const std::function<Result<DepthPhoto>()>& decode) {
  // A helper process cannot load decoders from files.
  if (DecodersAreConfined() && IsHeif(file)) LoadHeifDecoders();
  return Confined<DepthPhoto>(where, decode);
}

}  // namespace starfocus
