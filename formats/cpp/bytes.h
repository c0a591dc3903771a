// SPDX-License-Identifier: MIT
// A growable block of bytes aligned to 64, not initialised on growth, capacity kept: the storage of one array.
#pragma once
#include <cstddef>
#include <cstring>
#include <memory>
#include <new>
#include <utility>

namespace sheet::formats {

class Bytes {
public:
  Bytes() = default;
  explicit Bytes(std::size_t size) { resize(size); }
  Bytes(const Bytes& other) { assign(other.data(), other.size_); }
  Bytes(Bytes&& other) noexcept { swap(other); }
  Bytes& operator=(const Bytes& other) {
    if (this != &other)
      assign(other.data(), other.size_);
    return *this;
  }
  Bytes& operator=(Bytes&& other) noexcept {
    swap(other);
    return *this;
  }

  [[nodiscard]] std::byte* data() noexcept { return block_.get(); }
  [[nodiscard]] const std::byte* data() const noexcept { return block_.get(); }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }

  // Keeps the first min(size, old size) bytes; new bytes are not initialised.
  void resize(std::size_t size) {
    if (size > capacity_) {
      std::unique_ptr<std::byte[], Free> block(static_cast<std::byte*>(::operator new(size, alignment)));
      if (size_ > 0)
        std::memcpy(block.get(), block_.get(), size_);
      block_ = std::move(block);
      capacity_ = size;
    }
    size_ = size;
  }
  void assign(const std::byte* from, std::size_t size) {
    size_ = 0;
    resize(size);
    if (size > 0)
      std::memcpy(block_.get(), from, size);
  }
  void swap(Bytes& other) noexcept {
    std::swap(block_, other.block_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
  }
  bool operator==(const Bytes& other) const noexcept {
    return size_ == other.size_ && (size_ == 0 || std::memcmp(data(), other.data(), size_) == 0);
  }

private:
  static constexpr std::align_val_t alignment{64};
  struct Free {
    void operator()(std::byte* p) const noexcept { ::operator delete(p, alignment); }
  };
  std::unique_ptr<std::byte[], Free> block_;
  std::size_t size_ = 0, capacity_ = 0;
};

} // namespace sheet::formats
