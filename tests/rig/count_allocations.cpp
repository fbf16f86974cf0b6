// Replaces operator new for the whole test program. In a file of its own: g++ sees a mismatch of malloc and delete
// where it can inline only one of the pair. (The asan preset does without the check of pairs: what a driver loaded
// later allocates by its own operator new comes back to this delete.)

#include "tests/rig/count_allocations.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<std::size_t> allocations = 0;
}

std::size_t blush::test::allocation_count() { return allocations; }

void* operator new(std::size_t size) {
    ++allocations;
    if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
    throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
