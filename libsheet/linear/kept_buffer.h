// SPDX-License-Identifier: GPL-3.0-or-later
// Memory that only grows and is never given back while its owner lives: the system hands out fresh pages slowly, and a
// factorisation that follows another one should not wait for them. Pages already touched survive growing, contents are
// undefined. Aligned to pages, in huge ones where the system has them.
#pragma once
#include <cstddef>
#include <utility>

#include <sys/mman.h>

#include "libsheet/base/error.h"

namespace sheet {

template <class T> class KeptBuffer {
public:
  KeptBuffer() = default;
  KeptBuffer(KeptBuffer&& other) noexcept
      : data_(std::exchange(other.data_, nullptr)), bytes_(std::exchange(other.bytes_, 0)) {}
  KeptBuffer& operator=(KeptBuffer&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(bytes_, other.bytes_);
    return *this;
  }
  ~KeptBuffer() {
    if (data_)
      munmap(data_, bytes_);
  }

  void reserve(std::size_t count) {
    std::size_t wanted = count * sizeof(T);
    if (wanted <= bytes_)
      return;
    if (bytes_ > 0)
      wanted += wanted / 4; // a mesh that grows does so again
    wanted = (wanted + huge_page - 1) / huge_page * huge_page;
    void* got = data_
                    ? mremap(data_, bytes_, wanted, MREMAP_MAYMOVE)
                    : mmap(nullptr, wanted, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (got == MAP_FAILED)
      fail(ExitCode::io, "out of memory: {} MB for the factorisation", wanted >> 20);
    madvise(got, wanted, MADV_HUGEPAGE);
    data_ = static_cast<T*>(got);
    bytes_ = wanted;
  }
  [[nodiscard]] T* data() const { return data_; }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

private:
  static constexpr std::size_t huge_page = std::size_t{1} << 21;
  T* data_ = nullptr;
  std::size_t bytes_ = 0;
};

} // namespace sheet
