# SPDX-License-Identifier: GPL-3.0-or-later
# Debian packages, made by packaging/make: sheet, sheet-formats-dev and sheet-doc, of what install.cmake says.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "Sheet maintainers <maintainers@sheet.example>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "") # each package has its own
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL programs formats-dev doc)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
                                                WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_PROGRAMS_PACKAGE_NAME sheet)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SHLIBDEPS ON)
# Loaded by sheet-step at run time, which shlibdeps cannot see (libsheet/linear/cholmod_library.cpp).
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_DEPENDS "libcholmod3, libopenblas0-pthread | libopenblas0")
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_RECOMMENDS ffmpeg)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SUGGESTS "sheet-formats-dev, sheet-doc, blender, paraview")
set(CPACK_DEBIAN_PROGRAMS_DESCRIPTION "simulator of thin sheets of viscous liquid
Chocolate that enrobes a truffle, batter that folds on a belt, glass that sags:
small programs that make, step, remesh, tear, collide, draw and measure sheets
with viscous stretching and bending, surface tension, inertia, gravity and
contact (the model of Discrete Viscous Sheets), and pass them through pipes.")

set(CPACK_DEBIAN_FORMATS-DEV_PACKAGE_NAME sheet-formats-dev)
set(CPACK_DEBIAN_FORMATS-DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_FORMATS-DEV_PACKAGE_DEPENDS "libfmt-dev, libxxhash-dev, python3, python3-numpy")
set(CPACK_DEBIAN_FORMATS-DEV_PACKAGE_SUGGESTS "python3-xxhash, python3-matplotlib, python3-meshio, pkg-config, cmake")
set(scripts ${PROJECT_SOURCE_DIR}/packaging)
set(CPACK_DEBIAN_FORMATS-DEV_PACKAGE_CONTROL_EXTRA "${scripts}/postinst;${scripts}/prerm")
set(CPACK_DEBIAN_FORMATS-DEV_DESCRIPTION "readers and writers of Sheet's streams in C++ and Python
A static C++ library with its headers and CMake configuration, and the Python
package sheetstream, to read, write and measure runs of Sheet and to write
stages of one's own.")

set(CPACK_DEBIAN_DOC_PACKAGE_NAME sheet-doc)
set(CPACK_DEBIAN_DOC_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOC_DESCRIPTION "simulator of thin sheets of viscous liquid - documentation
Pages for a browser: a tutorial, the model and its formulas, every program, a
gallery of scenes, and what was measured.")

foreach(part programs formats-dev doc)
  string(TOUPPER ${part} PART)
  set(folder ${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${PART}_PACKAGE_NAME})
  install(FILES packaging/copyright DESTINATION ${folder} COMPONENT ${part})
  install(FILES ${PROJECT_BINARY_DIR}/changelog.gz DESTINATION ${folder} COMPONENT ${part})
endforeach()
add_custom_command(OUTPUT ${PROJECT_BINARY_DIR}/changelog.gz DEPENDS packaging/changelog
  COMMAND gzip -9nc ${PROJECT_SOURCE_DIR}/packaging/changelog > ${PROJECT_BINARY_DIR}/changelog.gz)
add_custom_target(package_changelog ALL DEPENDS ${PROJECT_BINARY_DIR}/changelog.gz)
include(CPack)
