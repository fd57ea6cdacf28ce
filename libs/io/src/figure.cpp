#include "reprise/io/figure.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <set>
#include <stdexcept>

#include "reprise/io/files.hpp"
#include "reprise/io/gnuplot.hpp"

namespace reprise {

namespace {

/// Whether the picture is there to its end: gnuplot does not notice when its output is cut off.
bool is_whole(std::string_view picture, std::string_view extension) {
  while (picture.ends_with('\n')) picture.remove_suffix(1);
  if (extension == ".svg") return picture.starts_with("<?xml") && picture.ends_with("</svg>");
  if (extension == ".pdf") return picture.starts_with("%PDF") && picture.ends_with("%%EOF");
  return picture.starts_with("\x89PNG") && picture.ends_with("IEND\xae\x42\x60\x82");
}

/// Passes on what gnuplot says beside a picture, the same thing only once.
void pass_on(const std::string& warning) {
  static std::set<std::string> passed_on;
  if (!warning.empty() && passed_on.insert(warning).second) fmt::print(stderr, "gnuplot warns: {}\n", warning);
}

constexpr const char* style = R"(
set encoding utf8
set linetype 1 lc rgb '#0072b2' lw 2 pt 7 ps 0.5
set linetype 2 lc rgb '#d55e00' lw 2 pt 5 ps 0.5
set linetype 3 lc rgb '#009e73' lw 2 pt 9 ps 0.5
set linetype 4 lc rgb '#cc79a7' lw 2 pt 11 ps 0.5
set linetype 5 lc rgb '#e69f00' lw 2 pt 13 ps 0.5
set linetype 6 lc rgb '#56b4e9' lw 2 pt 7 ps 0.5
set linetype 7 lc rgb '#000000' lw 2 pt 5 ps 0.5
set linetype 8 lc rgb '#8c8c8c' lw 2 pt 9 ps 0.5
set linetype cycle 8
set border 3 lw 1 lc rgb '#404040'
set tics nomirror out scale 0.6 textcolor rgb '#202020'
set grid lw 0.6 lc rgb '#e4e4e4'
set key outside bottom center horizontal samplen 2.5
set style textbox opaque noborder margins 0.4, 0.3 fillcolor rgb '#ffffff'
)";

}  // namespace

double round_step(double length, double most) {
  const double power = std::pow(10.0, std::floor(std::log10(length / most)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power * most >= length) return factor * power;
  }
  return 10.0 * power;
}

Figure::Figure(int width, int height) : width_(width), height_(height) {}

std::string Figure::add_data(const std::vector<std::vector<double>>& rows) {
  const std::string name = fmt::format("$data{}", ++data_count_);
  script_ += fmt::format("{} << END_OF_DATA\n", name);
  for (const std::vector<double>& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) script_ += fmt::format("{}{}", i == 0 ? "" : " ", row[i]);
    script_ += '\n';
  }
  script_ += "END_OF_DATA\n";
  return name;
}

void Figure::add(std::string_view command) {
  script_ += command;
  script_ += '\n';
}

void Figure::write(const std::filesystem::path& file) const {
  const std::string extension = file.extension().string();
  const auto terminal = [&]() -> std::string {
    constexpr const char* common = "font 'DejaVu Sans,13' background '#ffffff' noenhanced";
    if (extension == ".svg") return fmt::format("svg size {},{} {}", width_, height_, common);
    // The png has two pixels to a point, with everything in it scaled alike.
    if (extension == ".png") {
      return fmt::format("pngcairo size {},{} fontscale 1.5 linewidth 2 pointscale 2 {}", 2 * width_, 2 * height_,
                         common);
    }
    if (extension == ".pdf") {
      // A point is 1/96 inch, as in the svg; gnuplot's font size is in 1/72 inch.
      return fmt::format("pdfcairo size {}in,{}in fontscale 0.75 {}", width_ / 96.0, height_ / 96.0, common);
    }
    throw std::logic_error(fmt::format("no picture is drawn with the extension '{}'", extension));
  }();
  const GnuplotRun run = [&] {
    try {
      return run_gnuplot({"-d"}, fmt::format("set terminal {}\n{}{}\nunset output\n", terminal, style, script_),
                         time_limit_);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(fmt::format("{} is not drawn: {}", file.string(), error.what()));
    }
  }();
  if (!is_whole(run.output, extension)) {
    throw std::runtime_error(fmt::format("{} is not drawn: gnuplot left {}{}{}", file.string(),
                                         run.output.empty() ? "no picture" : "only a part of the picture",
                                         run.said.empty() ? "." : ": ", run.said));
  }
  pass_on(run.said);
  write_file(file, run.output);
}

const std::vector<std::string>& Figure::extensions() {
  static const std::vector<std::string> all{".svg", ".png", ".pdf"};
  return all;
}

std::vector<std::string> Figure::write(const std::filesystem::path& folder, const std::string& name) const {
  std::vector<std::string> files;
  for (const char* extension : {".svg", ".png"}) {
    files.push_back(name + extension);
    write(folder / files.back());
  }
  return files;
}

std::vector<std::vector<double>> outline_rows(const Table& points) {
  std::vector<std::vector<double>> rows;
  for (std::size_t i = 0; i <= points.rows(); ++i) {
    const std::size_t row = i % points.rows();
    rows.push_back({points.number(row, "x"), points.number(row, "y")});
  }
  return rows;
}

std::string gnuplot_string(std::string_view text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace reprise
