# SPDX-License-Identifier: GPL-3.0-or-later
target_link_libraries(unit_remesh PRIVATE remesh_support sheet_flow)
