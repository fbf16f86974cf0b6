#pragma once
/// Result<T>: a value, or one sentence that says what is wrong with the caller's data.
///
/// Stands in for std::expected, which g++ 12 does not have. An Error's message names the file, the place in the file
/// and the reason; it is written for the person who typed the command.

#include <cassert>
#include <string>
#include <utility>
#include <variant>

namespace blush {

struct Error {
    std::string message;
};

template <class T>
class [[nodiscard]] Result {
public:
    Result(T value) : state_(std::move(value)) {}
    Result(Error error) : state_(std::move(error)) {}

    explicit operator bool() const { return std::holds_alternative<T>(state_); }
    T& operator*() & { return get(); }
    const T& operator*() const& { return get(); }
    T&& operator*() && { return std::move(get()); }
    T* operator->() { return &get(); }
    const T* operator->() const { return &get(); }
    const Error& error() const {
        assert(!*this && "Result::error() called on a value");
        return *std::get_if<Error>(&state_);
    }

private:
    T& get() {
        assert(*this && "Result dereferenced while it holds an error");
        return *std::get_if<T>(&state_);
    }
    const T& get() const {
        assert(*this && "Result dereferenced while it holds an error");
        return *std::get_if<T>(&state_);
    }
    std::variant<T, Error> state_;
};

/// The result of an operation that yields nothing but may fail.
struct Done {};
using Status = Result<Done>;

}  // namespace blush
