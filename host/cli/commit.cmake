# Writes OUT, which defines WHISKER_COMMIT, if the commit of ROOT has changed since it was written.
set(commit unknown)
find_program(git git)
if(git)
  # Sources unpacked inside another repository have no commit of their own.
  execute_process(COMMAND ${git} -C ${ROOT} rev-parse --show-prefix
    OUTPUT_VARIABLE prefix RESULT_VARIABLE failed OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(NOT failed AND prefix STREQUAL "")
    execute_process(COMMAND ${git} -C ${ROOT} describe --always --dirty --abbrev=12
      OUTPUT_VARIABLE described RESULT_VARIABLE failed OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(NOT failed AND described MATCHES "^[-.+A-Za-z0-9]+$")
      set(commit ${described})
    endif()
  endif()
endif()
set(text "#define WHISKER_COMMIT \"${commit}\"\n")
set(old "")
if(EXISTS ${OUT})
  file(READ ${OUT} old)
endif()
if(NOT old STREQUAL text)
  file(WRITE ${OUT} "${text}")
endif()
