// SPDX-License-Identifier: GPL-3.0-or-later
// Functions that are compiled once for each of several instruction sets, one of which is chosen when a program starts.
#pragma once

// Before a function: SHEET_FOR_INSTRUCTION_SETS("avx2"), and one for any processor, too. Sanitizers cannot run what
// chooses, and Clang wants it at the first declaration.
#if defined(__x86_64__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SHEET_FOR_INSTRUCTION_SETS(...) [[gnu::target_clones(__VA_ARGS__, "default")]]
#else
#define SHEET_FOR_INSTRUCTION_SETS(...)
#endif
