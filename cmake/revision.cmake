# cmake -DSOURCE_DIR=... -DOUTPUT=... -P revision.cmake: writes the checkout's revision as C++, and leaves the file alone
# where nothing changed.
find_package(Git QUIET)
set(revision "")
if(Git_FOUND)
  execute_process(COMMAND ${GIT_EXECUTABLE} -C ${SOURCE_DIR} describe --always --dirty --abbrev=7 --exclude=*
                  OUTPUT_VARIABLE revision OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
if(NOT revision)
  set(revision "no revision")  # an archive without .git
endif()
set(text "#include \"commands/revision.h\"\n\nconst char* const wavepath::revision = \"${revision}\";\n")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} before)
endif()
if(NOT text STREQUAL "${before}")
  file(WRITE ${OUTPUT} "${text}")
endif()
