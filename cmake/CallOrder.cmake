# halfspace_call_order(TARGET): links TARGET with the functions of called.gen.txt, beside its CMakeLists.txt, first and in that
# order. The system maps the 64 KB around each page of code that is touched, so that code which runs lies together, or all
# of it becomes resident. `@` in a name stands for an instruction set, and those follow each other.
#
# bench/call_order.py writes the lists. A name that is not there any more does no harm.
function(halfspace_call_order target)
  if(HALFSPACE_SANITIZE)
    return()
  endif()
  set(list "${CMAKE_CURRENT_SOURCE_DIR}/called.gen.txt")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${list}")
  file(STRINGS "${list}" names REGEX "^[^#]")
  set(leveled "${names}")
  list(FILTER names EXCLUDE REGEX "@")
  list(FILTER leveled INCLUDE REGEX "@")
  foreach(level 6N_AVX3 6N_AVX2 6N_SSE4 8N_SCALAR)
    string(REPLACE "@" "${level}" of_level "${leveled}")
    list(APPEND names ${of_level})
  endforeach()
  list(TRANSFORM names REPLACE "^(.+)$" "    *(.text.\\1 .text.\\1.* .text.unlikely.\\1)")
  list(JOIN names "\n" lines)
  set(script "${CMAKE_CURRENT_BINARY_DIR}/${target}_call_order.ld")
  file(CONFIGURE OUTPUT "${script}" CONTENT "SECTIONS {\n  .text.called : {\n${lines}\n  }\n} INSERT BEFORE .text;\n" @ONLY)
  # Linkers that know no INSERT leave the order as it is.
  include(CheckLinkerFlag)
  check_linker_flag(CXX "-Wl,-T,${script}" HALFSPACE_LINKER_INSERTS)
  if(NOT HALFSPACE_LINKER_INSERTS)
    return()
  endif()
  target_link_options(${target} PRIVATE "-Wl,-T,${script}")
  set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS "${script}")
endfunction()
