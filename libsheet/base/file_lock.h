// SPDX-License-Identifier: GPL-3.0-or-later
// A file has one writer at a time.
#pragma once
#include <string>

namespace sheet {

// Locks the regular file (flock) until its descriptor is closed everywhere, or unlock() is called. Throws Error (io),
// naming the process that writes it already. Where the file system knows no locks, nothing is locked.
void lock_for_writing(int descriptor, const std::string& name);
void unlock(int descriptor);

} // namespace sheet
