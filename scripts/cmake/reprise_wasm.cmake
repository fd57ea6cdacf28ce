# What the build for WebAssembly needs before any package is looked for. Only headers of other projects are used, from
# links in a folder of their own: the rest of the folder that they are in belongs to this machine's C library.

set(WASM_HEADERS ${PROJECT_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${WASM_HEADERS})
foreach(project boost fmt nlohmann toml++)
  if(NOT IS_DIRECTORY /usr/include/${project})
    message(FATAL_ERROR "There is no folder /usr/include/${project}; scripts/setup build explorer installs what is needed.")
  endif()
  file(CREATE_LINK /usr/include/${project} ${WASM_HEADERS}/${project} SYMBOLIC)
endforeach()

set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE BOTH)
set(Boost_NO_BOOST_CMAKE ON)
set(Boost_INCLUDE_DIR ${WASM_HEADERS})
list(APPEND CMAKE_PREFIX_PATH /usr)

# One module is linked of everything, at fixed places.
set(CMAKE_CXX_COMPILE_OPTIONS_PIC "")

# What its standard library lacks.
include_directories(BEFORE ${PROJECT_SOURCE_DIR}/apps/explorer/standard)
