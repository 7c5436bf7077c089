// SPDX-License-Identifier: Apache-2.0
// The HCI 4D light-field benchmark: input_Cam000.png ... in rows of a square, gt_disp_lowres.pfm of
// the centre view, and parameters.cfg.
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
