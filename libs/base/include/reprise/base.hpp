#pragma once

// The whole library: constants, checks of arguments and work in threads.

#include "reprise/base/constants.hpp"
#include "reprise/base/in_threads.hpp"
#include "reprise/base/require.hpp"
