// wind.h: the wind's fields that bough_c.h has, put into a wind that keeps its others. Throws WrongCall, and then leaves a wind that may be half
// changed.
#pragma once
#include "call.h"
#include "lib/model/scene.h"

namespace bough::c {

void change(Wind&, const bough_wind*);

} // namespace bough::c
