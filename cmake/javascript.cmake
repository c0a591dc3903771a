# SPDX-License-Identifier: GPL-3.0-or-later
# module_text(VARIABLE FILE): the text of a JavaScript module as it stands in a page of one script: what it exports is in an
# object with the file's name (plots.js: plots_js), what it imports comes from those of modules that stand before it, and
# all else is its own. Modules import by lines `import {a, b} from "./NAME.js";` and export consts, functions and classes
# where they are declared.
function(module_text variable file)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(READ ${file} text)
  get_filename_component(name ${file} NAME_WE)
  string(REGEX MATCHALL "export (async function|function|class|const) [A-Za-z0-9_$]+" exported "${text}")
  list(TRANSFORM exported REPLACE "^.* " "")
  list(JOIN exported ", " exported)
  string(REGEX REPLACE "export (async function|function|class|const) " "\\1 " text "${text}")
  string(REGEX REPLACE "import ({[^}]*}) from \"\\./([a-z]+)\\.js\";" "const \\1 = \\2_js;" text "${text}")
  set(${variable} "const ${name}_js = (() => {\n${text}\nreturn {${exported}};\n})();\n" PARENT_SCOPE)
endfunction()
