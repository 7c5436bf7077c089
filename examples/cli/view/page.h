// SPDX-License-Identifier: Apache-2.0
// A page of HTML with everything in it: pictures are data URIs, and nothing is asked from anywhere.
#ifndef STARFOCUS_EXAMPLES_CLI_VIEW_PAGE_H_
#define STARFOCUS_EXAMPLES_CLI_VIEW_PAGE_H_

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "platform/file.h"
#include "platform/image.h"
#include "platform/result.h"
#include "starfocus/starfocus.h"

namespace starfocus {

struct PageFigure {
  std::string says;     // what is to be seen, for who does not see it
  std::string caption;  // what is to be known of it
  Image picture;
};

// Texts are plain: what HTML takes for its own is escaped.
class Page {
 public:
  // `icc` is the colour profile of the pictures that follow, empty for sRGB.
  Page(const std::string& title, const Bytes& icc);

  void AddTable(const std::vector<std::pair<std::string, std::string>>& rows);

  // Figures under a heading, the pictures of at most `width` pixels, side by side where there is
  // room. The error is about `path`, the page's own.
  Error AddFigures(const std::string& path, const std::string& heading,
                   const std::vector<PageFigure>& figures, int width);

  // Bars, and the numbers as a table to unfold.
  void AddHistogram(const std::string& heading, const std::vector<int64_t>& counts,
                    const starfocus_disparity_stats& stats);

  // The whole file.
  std::string Html() const;

 private:
  std::string head_, body_;
  const Bytes icc_;
};

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_VIEW_PAGE_H_
