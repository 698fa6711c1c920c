// Brought into every file of a copy of the tree by mutation.py: one of many changes is switched on by the
// environment.
#pragma once
#if __cplusplus >= 202002L  // not where CMake tries the compiler
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <type_traits>
#include <utility>

namespace courant_mutants {

inline constexpr int most = 4096;  ///< numbers of changes

/// COURANT_MUTANT, or -1: nothing is changed.
inline const int chosen = [] {
  const char* text = std::getenv("COURANT_MUTANT");
  return text ? std::atoi(text) : -1;
}();

/// One byte for each change, not 0 where its location was reached: the file COURANT_MUTANTS_REACHED, which
/// all processes share.
inline char* const reached = [] {
  const char* path = std::getenv("COURANT_MUTANTS_REACHED");
  const int file = path ? open(path, O_RDWR) : -1;
  if (file < 0) return static_cast<char*>(nullptr);
  void* at = mmap(nullptr, most, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  close(file);
  return at == MAP_FAILED ? nullptr : static_cast<char*>(at);
}();

inline bool on(int change) {
  if (reached) reached[change] = 1;
  return change == chosen;
}

/// a + b becomes a + Sign{n} * b.
struct Sign {
  int change;
};
template <class T>
auto operator*(Sign s, const T& b) {
  if constexpr (requires { typename T::PlainObject; }) {
    typename T::PlainObject out = b;
    if (on(s.change)) out = -b;
    return out;
  } else {
    using U = std::remove_cvref_t<decltype(+b)>;
    return on(s.change) ? U(-b) : U(b);
  }
}

/// a * b becomes a * One{n} * b, where a may be no number: what comes after is left out.
struct One {
  int change;
};
template <class A>
struct Times {
  A a;
  int change;
};
template <class A>
auto operator*(const A& a, One one) {
  if constexpr (requires { typename A::PlainObject; })
    return Times<typename A::PlainObject>{a, one.change};
  else
    return Times<A>{a, one.change};
}
template <class A, class B>
requires std::is_arithmetic_v<B>
auto operator*(const Times<A>& t, const B& b) {
  if constexpr (std::is_arithmetic_v<A>)
    return on(t.change) ? decltype(t.a * b)(t.a) : t.a * b;
  else
    return A(on(t.change) ? A(t.a) : A(t.a * b));
}

/// a / b becomes a / Inverse{n} / b: the quotient becomes a product.
struct Inverse {
  int change;
};
template <class A>
struct Over {
  A a;
  int change;
};
template <class A>
auto operator/(const A& a, Inverse inverse) {
  if constexpr (requires { typename A::PlainObject; })
    return Over<typename A::PlainObject>{a, inverse.change};
  else
    return Over<A>{a, inverse.change};
}
template <class A, class B>
requires std::is_arithmetic_v<B>
auto operator/(const Over<A>& t, const B& b) {
  if constexpr (std::is_arithmetic_v<A>)
    return on(t.change) ? t.a * b : t.a / b;
  else
    return A(on(t.change) ? A(t.a * b) : A(t.a / b));
}

/// a < b becomes a < Compare{n} < b; what it turns into is the comparison of the name.
struct ToEqualToo {
  int change;
};
struct ToOpposite {
  int change;
};
template <class A, class How>
struct Left {
  const A& a;
  int change;
};
#define COURANT_COMPARE(OP, EQUAL_TOO, OPPOSITE)                  \
  template <class A>                                              \
  Left<A, ToEqualToo> operator OP(const A& a, ToEqualToo how) {   \
    return {a, how.change};                                       \
  }                                                               \
  template <class A>                                              \
  Left<A, ToOpposite> operator OP(const A& a, ToOpposite how) {   \
    return {a, how.change};                                       \
  }                                                               \
  template <class A, class B>                                     \
  bool operator OP(const Left<A, ToEqualToo>& left, const B& b) { \
    return on(left.change) ? left.a EQUAL_TOO b : left.a OP b;    \
  }                                                               \
  template <class A, class B>                                     \
  bool operator OP(const Left<A, ToOpposite>& left, const B& b) { \
    return on(left.change) ? left.a OPPOSITE b : left.a OP b;     \
  }
COURANT_COMPARE(<, <=, >=)
COURANT_COMPARE(<=, <, >)
COURANT_COMPARE(>, >=, <=)
COURANT_COMPARE(>=, >, <)
COURANT_COMPARE(==, !=, !=)
COURANT_COMPARE(!=, ==, ==)
#undef COURANT_COMPARE

/// std::min(a, b) becomes Least{n, true}(a, b); `least` false: std::max.
struct Least {
  int change;
  bool least;
  template <class T>
  T operator()(const T& a, const T& b) const {
    return on(change) != least ? (b < a ? b : a) : (a < b ? b : a);
  }
};

}  // namespace courant_mutants
#endif
