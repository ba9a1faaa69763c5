// copied.h: a pointer to an object whose type is known at run time. It is copied with what it holds, as a value is: a copy shares nothing.
#pragma once
#include <memory>
#include <utility>

namespace bough {

// T has clone() const, which returns std::unique_ptr<T>. It is constant as a value is: through a const Copied only const T is reached.
template <class T> class Copied {
public:
    Copied() = default;
    Copied(std::unique_ptr<T> held) : held_(std::move(held)) {}
    Copied(const Copied& other) : held_(other.held_ ? other.held_->clone() : nullptr) {}
    Copied(Copied&&) noexcept = default;
    Copied& operator=(Copied other) noexcept {
        held_.swap(other.held_);
        return *this;
    }
    ~Copied() = default;

    explicit operator bool() const { return held_ != nullptr; }
    T& operator*() { return *held_; }
    const T& operator*() const { return *held_; }
    T* operator->() { return held_.get(); }
    const T* operator->() const { return held_.get(); }

private:
    std::unique_ptr<T> held_;
};

// Gives a struct clone() for a base of many kinds: struct Own : Cloned<Own, Parent, Base>, with Parent derived from Base, or Base itself.
template <class Own, class Parent, class Base = Parent> struct Cloned : Parent {
    using Parent::Parent;
    std::unique_ptr<Base> clone() const override { return std::make_unique<Own>(static_cast<const Own&>(*this)); }
};

} // namespace bough
