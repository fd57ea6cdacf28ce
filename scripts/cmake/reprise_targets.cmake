# The kinds of target the house has: a library, a library of programs, a room of the experiments, a test program and an
# experiment.

include(GNUInstallDirs)

add_library(reprise_warnings INTERFACE)
target_compile_options(reprise_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -ffp-contract=off)

# A compiler cache where one is found, which spares what any clone below the same cache has compiled before. Precompiled
# headers hold headers of packages alone, so their macros and times need no looking at.
if(CMAKE_CXX_COMPILER_LAUNCHER)
  # One that the user has chosen: a cache that has not been told so would forget everything when a header changes.
  set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)
elseif(PROJECT_IS_TOP_LEVEL)
  find_program(CCACHE_PROGRAM ccache)
  if(CCACHE_PROGRAM)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
      CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE_PROGRAM})
    add_compile_options(
      $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess> "$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>")
  endif()
endif()

# A linker several times faster than the usual one, where it is found. WebAssembly has its own.
if(PROJECT_IS_TOP_LEVEL AND NOT EMSCRIPTEN)
  find_program(MOLD_PROGRAM mold)
  if(MOLD_PROGRAM)
    add_link_options(-fuse-ld=mold)
  endif()
endif()

# The sources of a library are compiled a few at a time, so that what they share is compiled once: half the time of a
# first build. A source still includes what it uses, and its names do not meet those of its neighbours: the presets dev
# and clang compile each alone.
option(REPRISE_TOGETHER "Compile the sources of a library a few at a time" ${PROJECT_IS_TOP_LEVEL})
function(reprise_compile_together target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${REPRISE_TOGETHER} UNITY_BUILD_BATCH_SIZE 6)
endfunction()

# reprise_precompile(<kind> LINK <target>... HEADERS <header>...) compiles headers once for all targets of a kind, in
# reprise_<kind>_headers. A source still includes what it uses: the preset dev compiles without this.
function(reprise_precompile kind)
  cmake_parse_arguments(arg "" "" "LINK;HEADERS" ${ARGN})
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${kind}_headers.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "// Only here for the headers to be compiled with it.\n")
  add_library(reprise_${kind}_headers OBJECT ${source})
  target_compile_features(reprise_${kind}_headers PRIVATE cxx_std_20)
  target_link_libraries(reprise_${kind}_headers PRIVATE ${arg_LINK} reprise_warnings)
  target_precompile_headers(reprise_${kind}_headers PRIVATE ${arg_HEADERS})
endfunction()

# reprise_add_library(<name> SOURCES <file>... [PUBLIC <target>...] [PRIVATE <target>...])
# declares and installs reprise::<name> from the current folder's include/ and the given sources.
function(reprise_add_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  set(target reprise_${name})
  add_library(${target} STATIC ${arg_SOURCES})
  add_library(reprise::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_precompile_headers(${target} REUSE_FROM reprise_library_headers)
  reprise_compile_together(${target})
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(${target} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE} $<BUILD_INTERFACE:reprise_warnings>)
  install(TARGETS ${target} EXPORT reprise_targets)
  set_property(GLOBAL APPEND PROPERTY REPRISE_COMPONENTS ${name})
  install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endfunction()

# reprise_add_program_library(<name> SOURCES <file>... [PUBLIC <target>...] [PRIVATE <target>...])
# declares reprise_<name> from the current folder's include/ and the given sources: what the programs of this project
# share. It is not installed.
function(reprise_add_program_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(reprise_${name} STATIC ${arg_SOURCES})
  set_target_properties(reprise_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_compile_features(reprise_${name} PUBLIC cxx_std_20)
  target_precompile_headers(reprise_${name} REUSE_FROM reprise_program_library_headers)
  reprise_compile_together(reprise_${name})
  target_include_directories(reprise_${name} PUBLIC ${CMAKE_CURRENT_SOURCE_DIR}/include)
  target_link_libraries(reprise_${name} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE} reprise_warnings)
endfunction()

# reprise_add_room(<name> SOURCES <file>... [PUBLIC <target>...] [PRIVATE <target>...])
# declares reprise_<name>, a room of the experiments, whose headers are included as "<name>/<header>".
function(reprise_add_room name)
  cmake_parse_arguments(arg "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(reprise_${name} STATIC ${arg_SOURCES})
  target_precompile_headers(reprise_${name} REUSE_FROM reprise_program_headers)
  reprise_compile_together(reprise_${name})
  target_include_directories(reprise_${name} PUBLIC ${PROJECT_SOURCE_DIR}/experiments)
  target_link_libraries(reprise_${name} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE} reprise_warnings)
endfunction()

# reprise_add_check(<name> COMMAND <command>...) declares a test with the label of its folder, and with the label `long`
# when it is one of `long_tests`, which begin first.
function(reprise_add_check name)
  add_test(NAME ${name} ${ARGN})
  cmake_path(GET CMAKE_CURRENT_SOURCE_DIR FILENAME label)
  if(label STREQUAL "tests")
    set(label tools)
  endif()
  if(name IN_LIST long_tests)
    list(APPEND label long)
    set_tests_properties(${name} PROPERTIES COST 100)
  endif()
  set_tests_properties(${name} PROPERTIES LABELS "${label}")
endfunction()

# reprise_add_test(<name> SOURCES <file>... LINK <target>...) declares one Boost.Test program.
function(reprise_add_test name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINK" ${ARGN})
  add_executable(test_${name} ${arg_SOURCES})
  target_compile_definitions(test_${name} PRIVATE BOOST_TEST_DYN_LINK $<$<NOT:$<CONFIG:Release>>:REPRISE_FEW_SAMPLES>)
  target_precompile_headers(test_${name} REUSE_FROM reprise_test_headers)
  target_include_directories(test_${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_link_libraries(test_${name} PRIVATE reprise_test_main ${arg_LINK} Boost::unit_test_framework reprise_warnings)
  # The folder of the programs is for users; tests stay where they are built.
  set_target_properties(test_${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
  reprise_add_check(${name} COMMAND test_${name} --color_output=no)
endfunction()

# reprise_add_check_program(<name> SOURCES <file>... LINK <target>...) declares a program check_<name> that is a test as it
# is, and takes more cases when it is given numbers.
function(reprise_add_check_program name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINK" ${ARGN})
  add_executable(check_${name} ${arg_SOURCES})
  target_compile_definitions(check_${name} PRIVATE $<$<NOT:$<CONFIG:Release>>:REPRISE_FEW_SAMPLES>)
  target_include_directories(check_${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_link_libraries(check_${name} PRIVATE ${arg_LINK} reprise_warnings)
  set_target_properties(check_${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
  reprise_add_check(${name} COMMAND check_${name})
endfunction()

# reprise_read_manifest(<programs>) sets the list of the programs in experiments/manifest, and <program>_item and
# <program>_title for each of them.
function(reprise_read_manifest programs)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
    ${PROJECT_SOURCE_DIR}/experiments/manifest ${PROJECT_SOURCE_DIR}/scripts/manifest)
  execute_process(COMMAND ${PROJECT_SOURCE_DIR}/scripts/manifest rows OUTPUT_VARIABLE rows COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]+" rows "${rows}")
  foreach(row IN LISTS rows)
    string(REPLACE "|" ";" fields "${row}")
    list(GET fields 0 program)
    list(APPEND names ${program})
    list(GET fields 1 item)
    list(GET fields 2 title)
    set(${program}_item ${item} PARENT_SCOPE)
    set(${program}_title ${title} PARENT_SCOPE)
  endforeach()
  set(${programs} ${names} PARENT_SCOPE)
endfunction()

# reprise_add_experiments(LINK <target>...) declares, from <program>.cpp in the current folder, every program of the
# manifest, with its entry there as REPRISE_PROGRAM, and the target `experiments` that builds them all.
function(reprise_add_experiments)
  cmake_parse_arguments(arg "" "" "LINK" ${ARGN})
  add_custom_target(experiments)
  reprise_read_manifest(programs)
  foreach(program IN LISTS programs)
    add_executable(${program} ${program}.cpp)
    target_precompile_headers(${program} REUSE_FROM reprise_program_headers)
    target_compile_definitions(${program} PRIVATE
      REPRISE_PROGRAM={"${program}","${${program}_item}","${${program}_title}"})
    target_link_libraries(${program} PRIVATE ${arg_LINK} reprise_warnings)
    add_dependencies(experiments ${program})
  endforeach()
endfunction()
