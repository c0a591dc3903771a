# SPDX-License-Identifier: GPL-3.0-or-later
# What cmake --install puts into a system beside the programs (tools/), and which package has it (packages.cmake):
# programs; formats-dev: readers and writers of streams in C++ and Python; doc; notices: licences outside of packages,
# which have a file copyright.
include(CMakePackageConfigHelpers)
find_package(Python3 COMPONENTS Interpreter)

# C++
file(GLOB headers CONFIGURE_DEPENDS formats/cpp/*.h)
set(config ${CMAKE_INSTALL_LIBDIR}/cmake/Sheet)
install(FILES ${headers} DESTINATION include/sheet/formats/cpp COMPONENT formats-dev)
install(TARGETS sheet_formats EXPORT SheetTargets ARCHIVE COMPONENT formats-dev)
install(EXPORT SheetTargets NAMESPACE Sheet:: DESTINATION ${config} COMPONENT formats-dev)
configure_package_config_file(formats/cpp/SheetConfig.cmake.in ${PROJECT_BINARY_DIR}/SheetConfig.cmake
                              INSTALL_DESTINATION ${config})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/SheetConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/SheetConfig.cmake ${PROJECT_BINARY_DIR}/SheetConfigVersion.cmake
        DESTINATION ${config} COMPONENT formats-dev)

# Python: where Debian's packages have modules, or a user's own. The folder is known when it is installed.
install(CODE "set(python python${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR})
if(CMAKE_INSTALL_PREFIX MATCHES \"/usr$\")
  set(python python3)
endif()" COMPONENT formats-dev)
set(modules "lib/\${python}/dist-packages")
install(DIRECTORY formats/python/sheetstream DESTINATION "${modules}" COMPONENT formats-dev
        FILES_MATCHING PATTERN "*.py" PATTERN py.typed PATTERN __pycache__ EXCLUDE)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/sheetstream.dist-info/METADATA CONTENT
  "Metadata-Version: 2.1\nName: sheetstream\nVersion: ${PROJECT_VERSION}\nLicense: MIT\nRequires-Dist: numpy\n")
file(WRITE ${PROJECT_BINARY_DIR}/sheetstream.dist-info/INSTALLER "cmake\n")
install(DIRECTORY ${PROJECT_BINARY_DIR}/sheetstream.dist-info/
        DESTINATION "${modules}/sheetstream-${PROJECT_VERSION}.dist-info" COMPONENT formats-dev)

# Words and examples
set(docs ${CMAKE_INSTALL_DATADIR}/doc)
install(FILES README.md formats/sheet.md docs/write-your-own-stage.md DESTINATION ${docs}/sheet COMPONENT programs)
install(FILES LICENSE DESTINATION ${docs}/sheet COMPONENT notices)
install(FILES formats/LICENSE DESTINATION ${docs}/sheet RENAME LICENSE.formats COMPONENT notices)
install(PROGRAMS formats/python/example_stage.py formats/python/example_figure.py DESTINATION ${docs}/sheet/examples
        COMPONENT programs)
install(FILES formats/paraview/show_sheet.py DESTINATION ${CMAKE_INSTALL_DATADIR}/sheet COMPONENT programs)
install(DIRECTORY formats/cpp/example/ DESTINATION ${docs}/sheet-formats-dev/examples COMPONENT formats-dev)
install(DIRECTORY ${PROJECT_BINARY_DIR}/site/ DESTINATION ${docs}/sheet-doc/html COMPONENT doc OPTIONAL) # site/make
