# Writes the files that only the package of Debian has: its changelog and the statement of copyright. CPack runs this
# between installing and packing.
set(usr ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/usr)
set(folder ${usr}/share/doc/alembert)
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE ${folder}/changelog.Debian "alembert (${CPACK_PACKAGE_VERSION}-1) unstable; urgency=low

  * Built from the sources; what is new stands in changelog.gz.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")
configure_file(${CPACK_ALEMBERT_SOURCE}/CHANGELOG.md ${folder}/changelog COPYONLY)
configure_file(${CPACK_ALEMBERT_SOURCE}/cmake/copyright ${folder}/copyright COPYONLY)
execute_process(COMMAND gzip -9nf ${folder}/changelog.Debian ${folder}/changelog COMMAND_ERROR_IS_FATAL ANY)
# CPack strips programs; static libraries must keep the symbols that a linker needs.
file(GLOB libraries ${usr}/lib/*.a ${usr}/lib/*/*.a)
execute_process(COMMAND strip --strip-debug --remove-section=.comment ${libraries} COMMAND_ERROR_IS_FATAL ANY)
