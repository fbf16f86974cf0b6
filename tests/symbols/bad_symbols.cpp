// Not used: shows that check.sh finds what it looks for.

#include <glm/glm.hpp>

namespace bad {

int counter = 0;

template <class T>
struct Shared {
    static inline int count = 0;
};
int& count() { return Shared<int>::count; }

glm::mat4 product(const glm::mat4& a, const glm::mat4& b) { return a * b; }

}  // namespace bad
