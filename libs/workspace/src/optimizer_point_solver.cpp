#include "reprise/workspace/point_solver.hpp"
