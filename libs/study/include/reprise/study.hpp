#pragma once

// The whole library: problem files, solvers by name, syntheses and documents.

#include "reprise/study/bound_claim.hpp"
#include "reprise/study/documents.hpp"
#include "reprise/study/drawing.hpp"
#include "reprise/study/formulation.hpp"
#include "reprise/study/mapped_workspace.hpp"
#include "reprise/study/pose_documents.hpp"
#include "reprise/study/problem_file.hpp"
#include "reprise/study/reach_search.hpp"
#include "reprise/study/scaled_problem.hpp"
#include "reprise/study/shape_reader.hpp"
#include "reprise/study/solvers.hpp"
#include "reprise/study/sweep.hpp"
#include "reprise/study/sweep_study.hpp"
#include "reprise/study/synthesis_advice.hpp"
#include "reprise/study/synthesis_documents.hpp"
#include "reprise/study/synthesis_run.hpp"
#include "reprise/study/synthesis_settings.hpp"
#include "reprise/study/workspace_map.hpp"
