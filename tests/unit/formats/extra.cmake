# SPDX-License-Identifier: GPL-3.0-or-later
add_test(NAME StreamCorpus.Python COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/formats/corpus_test.py)
set_tests_properties(StreamCorpus.Python PROPERTIES LABELS unit)
