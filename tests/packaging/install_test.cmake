# Installs into an empty folder and uses what lies there from outside the source tree, as a user would.
#   cmake -DBUILD=DIR -DFOLDER=DIR -P install_test.cmake
file(REMOVE_RECURSE ${FOLDER})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${FOLDER} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)

foreach(file IN ITEMS
        bin/wavepath share/bash-completion/completions/wavepath share/doc/wavepath/README.md
        share/doc/wavepath/copyright share/man/man1/wavepath.1 share/wavepath/scenes/cornell_box/scene.gltf
        share/wavepath/scenes/cornell_box/README.md share/wavepath/scenes/terrain/terrain.glb)
  if(NOT EXISTS ${FOLDER}/${file})
    message(FATAL_ERROR "${file} was not installed")
  endif()
endforeach()

file(READ ${FOLDER}/share/man/man1/wavepath.1 page)
if(NOT page MATCHES "^\\.TH WAVEPATH 1")
  message(FATAL_ERROR "share/man/man1/wavepath.1 is no manual page")
endif()
execute_process(
  COMMAND bin/wavepath render share/wavepath/scenes/cornell_box/scene.gltf -o picture.exr --size 16x16 --spp 1 --quiet
  WORKING_DIRECTORY ${FOLDER} COMMAND_ERROR_IS_FATAL ANY)
if(NOT EXISTS ${FOLDER}/picture.exr)
  message(FATAL_ERROR "the installed program wrote no picture")
endif()
