#include "operations.h"

namespace bough::fast {

constinit thread_local Operations operations_of_thread;

} // namespace bough::fast
