#pragma once

// The optimizers that the problems of the chord method are given to.

#include <memory>
#include <vector>

#include "reprise/optimizers/dynamic_q.hpp"
#include "reprise/optimizers/ipopt.hpp"
#include "reprise/optimizers/nlopt.hpp"

namespace reprise::test {

inline std::vector<std::shared_ptr<Solver>> optimizers() {
  NloptOptions ccsaq;
  ccsaq.algorithm = NloptAlgorithm::ccsaq;
  return {std::make_shared<DynamicQ>(), std::make_shared<IpoptSolver>(), std::make_shared<NloptSolver>(),
          std::make_shared<NloptSolver>(ccsaq)};
}

}  // namespace reprise::test
