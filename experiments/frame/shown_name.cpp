#include "frame/shown_name.hpp"

#include <algorithm>

#include "frame/source_tree.hpp"
#include "reprise/io/table.hpp"

namespace reprise::experiments {

std::string shown_name(const std::string& name) {
  static const Table names = read_table(data_folder() / "names.csv");
  const Table found = names.where("name", name);
  if (found.rows() == 1) return found.text(0, "shown");
  std::string text = name;
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

}  // namespace reprise::experiments
