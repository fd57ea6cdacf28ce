#pragma once

// The whole library: the check of a certificate.

#include "reprise/checker/check_certificate.hpp"
