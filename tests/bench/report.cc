#include "tests/bench/report.h"
namespace starfocus::bench {
std::string MakeReport(const Findings&, std::string* page) {
  *page = "x";
  return "";
}
}  // namespace starfocus::bench
