// SPDX-License-Identifier: Apache-2.0
// The figures that `starfocus-lab analyze` writes: tables of numbers, as CSV files and gnuplot
// drawings.
#ifndef STARFOCUS_EXAMPLES_LAB_ANALYSIS_FIGURES_H_
#define STARFOCUS_EXAMPLES_LAB_ANALYSIS_FIGURES_H_

#include <string>
#include <vector>

#include "platform/result.h"

namespace starfocus {

// A table with column headings. Each row has one cell per column.
class Table {
 public:
  Table(std::string name, std::vector<std::string> columns)
      : name_(std::move(name)), columns_(std::move(columns)) {}

  // Starts a row; the Add functions append its cells. Text must not contain quotes or line breaks.
  Table& Row() {
    rows_.emplace_back();
    return *this;
  }
  Table& Add(double value, const char* format = "%.9g");
  Table& Add(const std::string& text);

  const std::string& name() const { return name_; }
  std::string Csv() const;

  // Returns the table as the gnuplot data block $name.
  std::string DataBlock() const;

 private:
  std::string Text(const char* separator, const char* quote) const;

  std::string name_;
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
};

// A figure: its tables, and the gnuplot commands that draw it from their data blocks.
struct Figure {
  std::string name;  // name of the SVG file; empty: tables only
  int width = 0, height = 0;
  std::vector<Table> tables;
  std::string commands;

  std::string Script() const;
};

// Recomputes the tables and figures of section III of the paper from the definitions in that
// section.

// Functions whose names start with Analyse print a part of the summary to stdout.
Figure AnalyseTableOne();
Figure AnalyseViewNumber();  // Fig. 6 and the thresholds of (9)

// Functions whose names start with Draw do not print to stdout.
Figure DrawViewPsfs();         // Fig. 4.
Figure DrawViewResponses();    // Fig. 5.
Figure DrawSubsampledBlurs();  // Fig. 8.

// Returns the table of N for subapertures and checks the rule for N, for blur radii up to
// `max_blur`.
Figure AnalyseSubapertures(double max_blur);

// Measures the engine's PSFs for blur radii up to `largest`. Returns an error if the engine cannot
// be run.
Result<Figure> AnalyseEngine(int largest);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_LAB_ANALYSIS_FIGURES_H_
