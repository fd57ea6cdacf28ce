#include "reprise/workspace/trace.hpp"
