# Writes {"commit": ..., "dirty": ...} of the source tree to a file, when that is not its content already:
#   cmake -DSOURCE=<folder> -DOUTPUT=<file> -P write_source_state.cmake
# It runs with every build, and the programs read the file when they run. A header would name the commit as well, but
# every commit would then build every program anew and make every result look out of date.

set(git git -c safe.directory=${SOURCE} -C ${SOURCE})
execute_process(COMMAND ${git} rev-parse HEAD
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  set(state "{\"commit\": null, \"dirty\": null}\n")
else()
  execute_process(COMMAND ${git} status --porcelain OUTPUT_VARIABLE changes ERROR_QUIET)
  if(changes)
    set(dirty true)
  else()
    set(dirty false)
  endif()
  set(state "{\"commit\": \"${commit}\", \"dirty\": ${dirty}}\n")
endif()

set(old "")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} old)
endif()
if(NOT old STREQUAL state)
  file(WRITE ${OUTPUT} "${state}")
endif()
