#pragma once

// The whole library: files, tables, options, signals and pictures.

#include "reprise/io/compression.hpp"
#include "reprise/io/expression.hpp"
#include "reprise/io/figure.hpp"
#include "reprise/io/files.hpp"
#include "reprise/io/gnuplot.hpp"
#include "reprise/io/interruption.hpp"
#include "reprise/io/messages.hpp"
#include "reprise/io/number_range.hpp"
#include "reprise/io/options.hpp"
#include "reprise/io/progress.hpp"
#include "reprise/io/table.hpp"
#include "reprise/io/toml_reader.hpp"
