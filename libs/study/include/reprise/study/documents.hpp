#pragma once

// What the documents that programs print have in common, as JSON and as text; apps/reprise/json.md describes them.

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace reprise {

/// Keys in the order in which they are put in.
using Json = nlohmann::ordered_json;

/// The version of all documents; json.md describes them.
inline constexpr const char* schema = "reprise/1";

/// A point and points, as documents have them.
Json to_json(const Eigen::Vector2d& point);
/// A list of points [x, y].
Json to_json(const std::vector<Eigen::Vector2d>& points);

/// A number for people: six digits.
std::string short_number(double value);

/// A lower bound for people: the largest number of so many digits (1 to 15) that is not above the value, which is
/// finite.
std::string lower_number(double bound, int digits = 6);
/// An upper bound: the smallest number that is not below the value.
std::string upper_number(double bound, int digits = 6);

/// The same for a length, or with the power 2 an area, with its unit where there is one: "12.5 mm", "144 mm^2".
std::string with_unit(double value, const std::string& unit, int power = 1);

}  // namespace reprise
