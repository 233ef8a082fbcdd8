# `cmake --install build --prefix DIR`, and `cpack --config build/CPackConfig.cmake` for a Debian package.
include(GNUInstallDirs)

install(TARGETS wavepath)

# The manual page and the completion are the program's own words about its options, so the program writes them.
set(written_by_wavepath ${PROJECT_BINARY_DIR}/written_by_wavepath)
install(CODE "
  file(MAKE_DIRECTORY \"${written_by_wavepath}\")
  execute_process(COMMAND \"$<TARGET_FILE:wavepath>\" --man
                  OUTPUT_FILE \"${written_by_wavepath}/wavepath.1\" COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND \"$<TARGET_FILE:wavepath>\" --completion bash
                  OUTPUT_FILE \"${written_by_wavepath}/wavepath\" COMMAND_ERROR_IS_FATAL ANY)")
install(FILES ${written_by_wavepath}/wavepath.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${written_by_wavepath}/wavepath DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)

install(DIRECTORY scenes/ DESTINATION ${CMAKE_INSTALL_DATADIR}/wavepath/scenes
        FILES_MATCHING PATTERN "*.gltf" PATTERN "*.md")
install(FILES ${WAVEPATH_TERRAIN} DESTINATION ${CMAKE_INSTALL_DATADIR}/wavepath/scenes/terrain)

install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR} PATTERN ".*" EXCLUDE)
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The wavepath authors <wavepath@localhost>")
set(CPACK_PACKAGE_DESCRIPTION
    "wavepath renders glTF 2.0 scenes to OpenEXR by unbiased Monte Carlo path tracing, as a chain of small OpenCL kernels over queues of paths. It runs on any OpenCL 1.2 device; PoCL on the CPU is the default.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
# Linked libraries are found by dpkg-shlibdeps; a driver is loaded by the ICD loader and has to be named.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "gnuplot-nox")  # draws the charts of pages
set(CPACK_DEBIAN_PACKAGE_DEPENDS "ocl-icd-libopencl1 | libopencl1, pocl-opencl-icd | opencl-icd")
include(CPack)
