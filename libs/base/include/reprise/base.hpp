#pragma once

// The whole library: checks of arguments and work in threads.

#include "reprise/base/in_threads.hpp"
#include "reprise/base/require.hpp"
