# The commands of Reprise; `make help` lists them. CMake builds the programs, this file says which results are made
# from what. Its rules for the experiments come from the table experiments/manifest, which scripts/manifest reads.

SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c
.DEFAULT_GOAL := help
.DELETE_ON_ERROR:

# Nothing depends on the environment's language, nor on a temporary folder that is not there.
export LC_ALL := C.UTF-8
ifeq (,$(wildcard $(TMPDIR)/))
  unexport TMPDIR
endif

# One make at a time in a folder: a second one waits until the first has ended. For these goals make only takes the lock,
# and starts itself again inside it.
one_at_a_time := reproduce test asan experiment compare figures report verify bench count fuzz tsan night lint clang docs reprise explorer test-explorer bench-explorer python test-python install clean
goals_to_lock := $(filter $(one_at_a_time),$(MAKECMDGOALS))
ifeq ($(CURDIR),$(LOCKED))
  goals_to_lock :=
endif
ifneq (,$(goals_to_lock))

.PHONY: $(MAKECMDGOALS) locked
$(MAKECMDGOALS): locked ;
locked: export LOCKED := $(CURDIR)
locked:
	@mkdir -p build
	@flock --nonblock build/.lock true || echo "Another make is at work in this folder; waiting until it has ended." >&2
	@flock --close build/.lock $(MAKE) --no-print-directory $(MAKECMDGOALS)

else

.PHONY: $(one_at_a_time) help list format setup setup-clang setup-lint setup-count setup-docs setup-explorer setup-python build-programs begin

# SETUP=skip leaves the packages to the user.
install_packages := $(if $(filter skip,$(SETUP)),:,scripts/setup)

# From the manifest: the list of programs, those that take longest first, and for each of them inputs.<program> and
# pictures.<program>.
$(foreach assignment,$(shell scripts/manifest make),$(eval $(assignment)))
ifneq (0,$(.SHELLSTATUS))
  $(error experiments/manifest cannot be read)
endif

table_of = build/results/$(1)/$(1).csv
pictures_of = $(foreach name,$(pictures.$(1)),build/results/$(1)/$(name).svg build/results/$(1)/$(name).png)
# A program writes its provenance last, so a run that was cut short is made up for.
results_of = $(table_of) build/results/$(1)/$(1).json $(pictures_of)
# An input with a slash is a file, or a pattern of files; any other is a program, that is, the table it writes.
inputs_of = $(foreach input,$(inputs.$(1)),$(if $(findstring /,$(input)),$(wildcard $(input)),$(call table_of,$(input))))

# A program with those it takes its inputs from.
with_sources = $(1) $(foreach input,$(inputs.$(1)),$(if $(findstring /,$(input)),,$(call with_sources,$(input))))
# The comparisons of methods.
comparisons := $(filter compare_%,$(programs))

# Whatever makes several results makes them side by side, one for each core, and shows how they stand; one result alone
# shows what its program says.
ifneq (,$(filter reproduce report figures compare verify,$(MAKECMDGOALS)))
  step := scripts/step
  MAKEFLAGS += -j$(shell nproc)
endif

# The programs to build: for `make experiment` the chosen one, for `make compare` the comparisons, with those they take
# their inputs from; else all.
wanted := experiments
ifeq (compare,$(MAKECMDGOALS))
  wanted := $(sort $(foreach program,$(comparisons),$(call with_sources,$(program))))
endif
ifneq (,$(filter experiment,$(MAKECMDGOALS)))
  chosen := $(or $(filter $(NAME) $(NAME)_%,$(programs)),$(filter $(NAME)%,$(programs)))
  ifeq (,$(NAME))
    $(error make experiment needs the beginning of a program's name, such as NAME=table_5_3; make list shows them all)
  else ifeq (,$(chosen))
    $(error No program begins with NAME=$(NAME); make list shows them all)
  else ifneq (1,$(words $(chosen)))
    $(error NAME=$(NAME) is the beginning of several programs: $(chosen))
  endif
  ifeq (experiment,$(MAKECMDGOALS))
    wanted := $(sort $(call with_sources,$(chosen)))
  endif
endif

# `make figures` takes stored tables as they are, and draws from them; it computes only where a table is missing.
made := $(programs)
ifeq (figures,$(MAKECMDGOALS))
  drawn := $(foreach program,$(programs),$(if $(wildcard $(call table_of,$(program))),$(program)))
  made := $(filter-out $(drawn),$(programs))
endif

# The tests of what runs in threads.
threaded := experiment_judge ipopt global_optimum good_designs
blank := $(subst x,,x x)

help: ## show this list
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "make %-15s %s\n", $$1, $$2 }' Makefile

reproduce: report ## make every result and the report, and say how it stands; redoes only what has changed
	@build/bin/verify --judge
	@echo "The report is $(CURDIR)/build/paper/report.html, and report.pdf beside it to be printed."
	@echo "Tables and pictures are in $(CURDIR)/build/results."

test: setup ## build and run the tests
	@scripts/test release

asan: setup ## build and run the tests with the address and undefined-behaviour sanitizers
	@scripts/test asan

reprise: build/release/build.ninja ## build the program reprise alone
	@cmake --build --preset release --target reprise
	@echo "The program is build/bin/reprise."

explorer: setup-explorer build/wasm/build.ninja ## make the explorer: a page that computes in the browser, in build/explorer
	@cmake --build --preset wasm --target reprise_explorer
	@node apps/explorer/build.mjs build/wasm/apps/explorer/reprise_explorer build/explorer/index.html
	@echo "Open $(CURDIR)/build/explorer/index.html in a browser."

test-explorer: explorer build/explorer-tests/node_modules build/release/build.ninja ## test the explorer in a browser, against reprise
	@cmake --build --preset release --target reprise explorer_answers
	@node --test tests/explorer/*.test.mjs

bench-explorer: explorer build/explorer-tests/node_modules ## measure how long a frame takes while something is dragged
	@node tests/explorer/benchmark.mjs build/bench/explorer.csv

python: setup-python ## build the Python module; import works with build/python in PYTHONPATH
	@mkdir -p build
	@cmake --preset release -D REPRISE_BUILD_PYTHON=ON -D REPRISE_PYTHON_FOLDER="$(CURDIR)/build/python" \
	  -D Python_EXECUTABLE=/usr/bin/python3 >build/python.log || { cat build/python.log; exit 1; }
	@cmake --build --preset release --target reprise_python
	@echo "The module is in $(CURDIR)/build/python: PYTHONPATH=build/python /usr/bin/python3 -c 'import reprise'."

test-python: python ## test the Python module
	@cmake --build --preset release --target reprise
	@PYTHONPATH="$(CURDIR)/build/python" PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 -m pytest -p no:cacheprovider -q tests/python

install: reprise ## install the program reprise and the libraries; PREFIX=/usr/local says where
	@cmake --build --preset release --target reprise_standard_problems
	@cmake --install build/release --prefix "$(or $(PREFIX),/usr/local)" >build/install.log
	@echo "The program is $(or $(PREFIX),/usr/local)/bin/reprise."

list: ## list the tables and figures of the thesis, the program of each and its seconds
	@scripts/manifest list

experiment: $(if $(chosen),$(call results_of,$(chosen))) ## make one table or figure; NAME=table_5_3 begins its program's name
	@echo "The results are in build/results/$(chosen)."

compare: $(foreach program,$(comparisons),$(call results_of,$(program))) ## compare optimizers and methods with each other
	@echo "The results are in $(foreach program,$(comparisons),build/results/$(program))."

figures: $(foreach program,$(programs),$(call pictures_of,$(program))) ## draw the pictures from the stored tables

report: build/paper/report.html build/paper/report.pdf ## write the report, for screen and print, from the results

verify: $(call results_of,verify) ## hold the results against the thesis and against data/reference
	@build/bin/verify --judge

bench: build/release/build.ninja ## measure times and evaluations at length; writes build/bench
	@cmake --build --preset release --target benchmark_workspaces
	@build/bin/benchmark_workspaces --repetitions 20 --with-ipopt --out build/bench
	@echo "The tables are in $(CURDIR)/build/bench."

count: setup-count build/release/build.ninja ## count instructions of what must not become slower, against limits
	@cmake --build --preset release --target count_instructions
	@scripts/count build/release/tests/count/count_instructions

# RUNS=N for another number of mutated files and of random manipulators, SEED=N for others. SECONDS=N for so long on the
# geometry and then on the commands with their files instead, by libFuzzer, which looks for inputs that reach new code; it
# keeps them in build/libfuzzer, and begins with the examples and with files that were faults.
ifneq (,$(filter command,$(origin SECONDS)))
fuzz: setup-clang build/libfuzzer/build.ninja
	@cmake --build --preset libfuzzer --target fuzz_geometry fuzz_commands
	@mkdir -p build/libfuzzer/geometry build/libfuzzer/commands
	@grep --only-matching --no-filename --extended-regexp '[a-z_]{3,}' examples/*.toml | sort --unique | sed 's/.*/"&"/' \
	  >build/libfuzzer/words
	@build/libfuzzer/tests/fuzz/fuzz_geometry -max_total_time=$(SECONDS) -timeout=300 -max_len=256 -print_final_stats=1 \
	  -artifact_prefix=build/libfuzzer/ build/libfuzzer/geometry
	@build/libfuzzer/tests/fuzz/fuzz_commands -max_total_time=$(SECONDS) -timeout=300 -max_len=2048 -print_final_stats=1 \
	  -dict=build/libfuzzer/words -artifact_prefix=build/libfuzzer/ build/libfuzzer/commands examples tests/apps/corpus
else
fuzz: build/asan/build.ninja ## run reprise on 10,000 mutated files and random manipulators, with sanitizers
	@cmake --build --preset asan --target fuzz_reprise
	@build/asan/tests/apps/fuzz_reprise --inputs $(or $(RUNS),10000) --manipulators $(or $(RUNS),10000) \
	  --seed $(or $(SEED),1) --folder build/fuzz
endif

tsan: setup build/tsan/build.ninja ## test what runs in threads with the thread sanitizer
	@cmake --build --preset tsan --target $(threaded:%=test_%)
	@ctest --preset tsan --tests-regex '^($(subst $(blank),|,$(threaded)))$$'

# RUNS="regions modes" for some of the runs. What has passed on the same commit is not repeated.
night: setup-clang ## the long runs that look for faults, some hours; tests/long_runs.md describes them
	@scripts/night $(RUNS)

# ALL=1 for every source, not only those that have changed since origin/main.
# clang-tidy reads the headers that are compiled once for all.
lint: setup-lint build/clang/build.ninja ## check includes, layout, naming and common mistakes
	@cmake --build --preset clang --target reprise_library_headers reprise_program_headers reprise_program_library_headers reprise_test_headers
	@scripts/lint $(if $(ALL),all)

clang: setup-clang build/clang/build.ninja ## compile each source alone with clang, for its warnings and its includes
	@cmake --build --preset clang
	@echo "clang has nothing to warn of."

docs: setup-docs ## write the API pages from the public headers
	@mkdir -p build
	@doxygen scripts/doxygen.conf
	@echo "The pages begin at $(CURDIR)/build/docs/index.html."

format: setup-lint ## lay out the sources
	@git ls-files -z '*.cpp' '*.hpp' | xargs -0 clang-format -i

clean: ## remove everything that was built, results included
	rm -rf build

setup:
	@$(install_packages)

setup-clang:
	@$(install_packages) build clang

setup-lint:
	@$(install_packages) build clang lint

setup-count:
	@$(install_packages) build count

setup-explorer:
	@$(install_packages) build explorer

build/wasm/build.ninja: | setup-explorer

# Playwright drives the browser. A version is fixed by the lock file.
build/explorer-tests/node_modules: tests/explorer/package-lock.json
	@command -v npm >/dev/null || $(install_packages) explorer-npm
	@$(install_packages) explorer-browser
	@mkdir -p build/explorer-tests
	@cp tests/explorer/package.json tests/explorer/package-lock.json build/explorer-tests/
	@npm ci --prefix build/explorer-tests --no-audit --no-fund --silent
	@touch build/explorer-tests/node_modules

setup-python:
	@$(install_packages) build python

setup-docs:
	@$(install_packages) docs

build/%/build.ninja: CMakePresets.json | setup
	@cmake --preset $*

# What a job that was killed has left behind.
begin:
	@rm -rf build/steps

build-programs: build/release/build.ninja begin
	@cmake --build --preset release --target $(wanted)

# The build leaves a program that has not changed as it is, and with it its results.
$(programs:%=build/bin/%): build-programs ;

define result_rule
$(call results_of,$(1)) &: build/bin/$(1) $(call inputs_of,$(1))
	@rm -f build/results/$(1)/.[!.]*
	$(if $(step),@$(step) $(1) )build/bin/$(1) --out build/results/$(1)
endef
$(foreach program,$(made),$(eval $(call result_rule,$(program))))

define picture_rule
$(call pictures_of,$(1)) &: build/bin/$(1) $(call table_of,$(1))
	@rm -f build/results/$(1)/.[!.]*
	@$(step) $(1) build/bin/$(1) --redraw --out build/results/$(1)
endef
$(foreach program,$(drawn),$(if $(pictures.$(program)),$(eval $(call picture_rule,$(program)))))

build/paper/report.html build/paper/report.pdf &: $(foreach program,$(programs),$(call results_of,$(program))) \
    $(wildcard paper/* paper/*/* data/* data/*/*) experiments/manifest
	paper/build

endif
