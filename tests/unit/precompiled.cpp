// SPDX-License-Identifier: GPL-3.0-or-later
// Only what is precompiled for all unit tests.
