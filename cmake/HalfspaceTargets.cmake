# What every target of the house is built with. The numeric contract depends on the first line:
# no contraction, no fast-math, so that one command stream gives one image everywhere.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_C_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_C_COMPILER_LAUNCHER "${CCACHE_PROGRAM}")
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CCACHE_PROGRAM}")
endif()

add_library(halfspace_options INTERFACE)
target_compile_options(halfspace_options INTERFACE
  -ffp-contract=off -fno-math-errno
  -Wall -Wextra -Wconversion -Wshadow -Wdouble-promotion
  "$<$<BOOL:${HALFSPACE_WERROR}>:-Werror>")
target_include_directories(halfspace_options INTERFACE "${PROJECT_SOURCE_DIR}")

option(HALFSPACE_WERROR "Warnings are errors" OFF)
set(HALFSPACE_SANITIZE "" CACHE STRING "Sanitizers, as -fsanitize= takes them")
if(HALFSPACE_SANITIZE)
  # -g1 is enough for a report's lines; with variables as well the kernels take two thirds longer to compile.
  add_compile_options(-fsanitize=${HALFSPACE_SANITIZE} -g1 -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${HALFSPACE_SANITIZE})
endif()

# halfspace_clear_records(sources...): for sources that clear or copy records of some hundred bytes with each small draw.
# g++ takes `rep stos` and `rep movs` for that, which need some thirty cycles to start.
function(halfspace_clear_records)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$")
    set(strategy unrolled_loop:512:noalign,libcall:-1:noalign)
    set_source_files_properties(${ARGN} PROPERTIES
      COMPILE_OPTIONS "-mmemset-strategy=${strategy};-mmemcpy-strategy=${strategy}")
  endif()
endfunction()

# halfspace_room(NAME sources...): a room of the house, one static library.
function(halfspace_room name)
  add_library(halfspace_${name} STATIC ${ARGN})
  target_link_libraries(halfspace_${name} PRIVATE halfspace_options)
  target_compile_options(halfspace_${name} PRIVATE -ffunction-sections)
  target_include_directories(halfspace_${name} PUBLIC "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>")
endfunction()
