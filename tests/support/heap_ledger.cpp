// SPDX-License-Identifier: Apache-2.0
#include "support/heap_ledger.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

// The C library's own, by the names that it keeps for those who replace malloc().
// NOLINTBEGIN(readability-identifier-naming,bugprone-reserved-identifier)
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* memory);
}
// NOLINTEND(readability-identifier-naming,bugprone-reserved-identifier)

namespace {

struct Block {
  void* memory;
  std::size_t bytes;
};

// The ledger takes no memory itself. A test has one thread.
std::array<Block, 4096> blocks;
std::size_t count = 0, held = 0, most = 0;
bool is_open = false;

void* noted(void* memory, std::size_t bytes) {
  if (!is_open || memory == nullptr) return memory;
  if (count == blocks.size()) std::abort();
  blocks[count++] = {memory, bytes};
  held += bytes;
  most = std::max(most, held);
  return memory;
}

void forget(void* memory) {
  if (!is_open || memory == nullptr) return;
  for (std::size_t i = count; i-- > 0;) {
    if (blocks[i].memory != memory) continue;
    held -= blocks[i].bytes;
    blocks[i] = blocks[--count];
    return;
  }
}

}  // namespace

extern "C" {
void* malloc(std::size_t size) {
  return noted(__libc_malloc(size), size);
}
void* calloc(std::size_t items, std::size_t size) {
  return noted(__libc_calloc(items, size), items * size);
}
void* realloc(void* memory, std::size_t size) {
  forget(memory);
  return noted(__libc_realloc(memory, size), size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return noted(__libc_memalign(alignment, size), size);
}
void free(void* memory) {
  forget(memory);
  __libc_free(memory);
}
}

namespace geoloc::testing {

HeapLedger::HeapLedger() {
  count = held = most = 0;
  is_open = true;
}

HeapLedger::~HeapLedger() {
  is_open = false;
}

std::size_t HeapLedger::held_bytes() const {
  return held;
}

std::size_t HeapLedger::most_bytes() const {
  return most;
}

}  // namespace geoloc::testing
