# Precompiled headers: those of the standard library and of other projects, most of what a compiler reads here. Each set
# is compiled once and read by every target that is compiled with the same options.
#
# None of ours is in a set, so a header that has changed compiles what includes it and no more. But a file that forgot an
# include of the standard library would compile all the same: QUINCUNX_PCH=OFF, as in the presets `debug` and `fuzz`, compiles
# every file by what it includes itself.
option(QUINCUNX_PCH "Precompile the headers of other projects" ON)

set(standard_headers <algorithm> <array> <bit> <cmath> <cstdint> <filesystem> <fstream> <functional> <map> <memory> <mutex>
  <optional> <random> <set> <span> <string> <string_view> <variant> <vector> <fmt/format.h> <glm/glm.hpp>)

# quincunx_add_headers(NAME HEADERS ... LINKS ...): the set quincunx_<name>, to be named by quincunx_use_headers.
function(quincunx_add_headers name)
  cmake_parse_arguments(ARG "" "" "HEADERS;LINKS" ${ARGN})
  if(QUINCUNX_PCH)
    set(source ${PROJECT_BINARY_DIR}/${name}.cpp)
    file(CONFIGURE OUTPUT ${source} CONTENT "// Written by cmake/headers.cmake: a set of headers needs a file.\n")
    add_library(quincunx_${name} OBJECT ${source})
    target_link_libraries(quincunx_${name} PRIVATE ${ARG_LINKS} quincunx_flags fmt::fmt glm::glm)
    target_precompile_headers(quincunx_${name} PRIVATE ${standard_headers} ${ARG_HEADERS})
  endif()
endfunction()

# The target reads that set, or none where `name` is empty.
function(quincunx_use_headers target name)
  if(QUINCUNX_PCH AND name)
    target_precompile_headers(${target} REUSE_FROM quincunx_${name})
  endif()
endfunction()

# What takes longer to compile than it will ever run: the command line, reports and tests, mostly templates of others.
# What they call is optimised as ever. -O1 takes about half as long as -O3.
add_library(quincunx_quick_flags INTERFACE)
if(QUINCUNX_SANITIZE)
  # At -O0, and without the checks of UBSan at every access that AddressSanitizer or the processor tells of: a third of the time.
  # Tests that sum for long say so (quincunx_busy_flags).
  set(few_checks -fno-sanitize=null,vptr,alignment,object-size)
  target_compile_options(quincunx_quick_flags INTERFACE -O0 ${few_checks})
  add_library(quincunx_busy_flags INTERFACE)
  target_compile_options(quincunx_busy_flags INTERFACE -O1 ${few_checks})
else()
  target_compile_options(quincunx_quick_flags INTERFACE $<$<NOT:$<CONFIG:Debug>>:-O1>)
endif()

quincunx_add_headers(numeric_headers
  HEADERS <tbb/blocked_range.h> <tbb/parallel_for.h> <tbb/parallel_reduce.h>
  LINKS TBB::tbb)
quincunx_add_headers(program_headers
  HEADERS <fmt/ranges.h> <CLI/CLI.hpp> <nlohmann/json.hpp>
  LINKS quincunx_quick_flags CLI11::CLI11 nlohmann_json::nlohmann_json)

# Where templates of others are most of the work, several files make one translation unit, so that what they instantiate is
# compiled once. Names in their anonymous namespaces have to differ within a folder then. QUINCUNX_UNITY=OFF, as in the
# presets `debug` and `fuzz`, compiles each file by itself.
option(QUINCUNX_UNITY "Compile files of the command line, reports and tests several at a time" ON)
set(QUINCUNX_UNITY_BATCH 8 CACHE STRING "How many files at a time; 0: all of a target")
function(quincunx_compile_together target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${QUINCUNX_UNITY} UNITY_BUILD_BATCH_SIZE ${QUINCUNX_UNITY_BATCH})
endfunction()
