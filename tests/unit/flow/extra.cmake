# SPDX-License-Identifier: GPL-3.0-or-later
target_link_libraries(unit_flow PRIVATE remesh_support)
