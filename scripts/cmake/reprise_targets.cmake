# The two kinds of target the house has: a library and a test program.

add_library(reprise_warnings INTERFACE)
target_compile_options(reprise_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -ffp-contract=off)

# reprise_add_library(<name> SOURCES <file>... [PUBLIC <target>...] [PRIVATE <target>...])
# declares reprise::<name> from the current folder's include/ and the given sources.
function(reprise_add_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  set(target reprise_${name})
  add_library(${target} STATIC ${arg_SOURCES})
  add_library(reprise::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>)
  target_link_libraries(${target} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE} $<BUILD_INTERFACE:reprise_warnings>)
endfunction()

# reprise_add_test(<name> SOURCES <file>... LINK <target>...) declares one Boost.Test program.
function(reprise_add_test name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINK" ${ARGN})
  add_executable(test_${name} ${arg_SOURCES})
  target_compile_definitions(test_${name} PRIVATE BOOST_TEST_DYN_LINK BOOST_TEST_MODULE=${name})
  target_link_libraries(test_${name} PRIVATE ${arg_LINK} Boost::unit_test_framework reprise_warnings)
  add_test(NAME ${name} COMMAND test_${name} --color_output=no)
endfunction()
