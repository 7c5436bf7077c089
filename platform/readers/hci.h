// SPDX-License-Identifier: Apache-2.0
// Reads the HCI 4D light-field benchmark: a square array of views input_Cam000.png ..., the
// disparity map of the centre view in gt_disp_lowres.pfm, and parameters.cfg.
#ifndef STARFOCUS_PLATFORM_READERS_HCI_H_
#define STARFOCUS_PLATFORM_READERS_HCI_H_

#include <string>
#include <vector>

#include "platform/readers/capture.h"
#include "platform/result.h"

namespace starfocus {

bool IsHci(const std::vector<std::string>& names);

Result<Capture> OpenHci(const std::string& folder, const std::vector<std::string>& names);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_HCI_H_
