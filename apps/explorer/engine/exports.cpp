// What JavaScript calls.

#include <emscripten.h>

#include <optional>
#include <string>
#include <vector>

#include "answers.hpp"
#include "kappa_map.hpp"
#include "reprise/base/constants.hpp"

using namespace reprise;

EM_JS(void, report_to_page, (const char* iterate), { Module["report"](UTF8ToString(iterate)); });

namespace {

/// The file that the page last asked about, for the map.
std::optional<FileInput> shown;
std::string reply;
std::vector<float> values;

Interval range_of(double lower_deg, double upper_deg) { return {lower_deg * degree, upper_deg * degree}; }

}  // namespace

extern "C" {

/// respond() of answers.hpp.
EMSCRIPTEN_KEEPALIVE const char* explorer_respond(const char* request) {
  reply = explorer::respond(request);
  return reply.c_str();
}

/// respond_to_search() of answers.hpp; Module.report gets the iterates.
EMSCRIPTEN_KEEPALIVE const char* explorer_search(const char* request) {
  reply = explorer::respond_to_search(request, [](const std::string& iterate) { report_to_page(iterate.c_str()); });
  return reply.c_str();
}

/// Reads the file that map and kappa are about. Returns 0 where it cannot be read.
EMSCRIPTEN_KEEPALIVE int explorer_show(const char* file) {
  try {
    shown = read_input(file);
  } catch (const std::exception&) {
    shown.reset();
  }
  return shown.has_value();
}

/// map_kappa_inverse() of kappa_map.hpp.
EMSCRIPTEN_KEEPALIVE const float* explorer_map(double left, double bottom, double right, double top, int columns,
                                               int rows, double lower_deg, double upper_deg) {
  explorer::map_kappa_inverse(shown->manipulator,
                              Eigen::AlignedBox2d(Eigen::Vector2d(left, bottom), Eigen::Vector2d(right, top)), columns,
                              rows, range_of(lower_deg, upper_deg), values);
  return values.data();
}

/// least_kappa_inverse() of kappa_map.hpp.
EMSCRIPTEN_KEEPALIVE double explorer_kappa(double x, double y, double lower_deg, double upper_deg) {
  return explorer::least_kappa_inverse(shown->manipulator, {x, y}, range_of(lower_deg, upper_deg));
}
}
