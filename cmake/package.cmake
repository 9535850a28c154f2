# Installs the files that accompany the program and the library, and defines the package of Debian: cmake --build DIR
# --target package. The program itself writes the manual and the completion.
set(texts ${CMAKE_CURRENT_BINARY_DIR}/texts)
find_program(GZIP gzip)
add_custom_command(OUTPUT ${texts}/done
  COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:alembert> -DTO=${texts} -DGZIP=${GZIP} -P ${CMAKE_CURRENT_SOURCE_DIR}/cmake/texts.cmake
  COMMAND ${CMAKE_COMMAND} -E touch ${texts}/done
  DEPENDS alembert ${CMAKE_CURRENT_SOURCE_DIR}/cmake/texts.cmake COMMENT "Writing the manual and the completion")
add_custom_target(texts ALL DEPENDS ${texts}/done)

install(DIRECTORY ${texts}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR})
install(FILES ${texts}/alembert.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME alembert)
install(FILES ${texts}/_alembert DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
install(FILES ${texts}/alembert.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
install(FILES docs/scene.schema.json DESTINATION ${CMAKE_INSTALL_DATADIR}/alembert)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} FILES_MATCHING PATTERN "*.md")
install(FILES README.md README.zh.md CONTRIBUTING.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY scenes/textbook scenes/gallery scenes/stability DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples FILES_MATCHING PATTERN "*.toml")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME alembert)
set(CPACK_PACKAGE_VENDOR "the alembert authors")
set(CPACK_PACKAGE_CONTACT "the alembert authors <alembert@example.org>")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "equations of motion derived, proved, emitted and integrated")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION  # CPack writes the summary before it
"From a description of a mechanical system in a text file, alembert derives the
equations of motion in symbols by several formalisms, judges derivations made
by hand, writes a C++ solver for this one system, compiles and integrates it,
and says how large the error is.

The package has the program, the libraries with their headers for
find_package(alembert), the manual and the documentation.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "g++ | clang")  # simulate, sweep and bench need a compiler
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "cmake, pkg-config, libeigen3-dev, libfmt-dev, libginac-dev, libcln-dev")  # for find_package(alembert)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_SOURCE_DIR}/cmake/debian.cmake)
set(CPACK_ALEMBERT_SOURCE ${CMAKE_CURRENT_SOURCE_DIR})
include(CPack)
