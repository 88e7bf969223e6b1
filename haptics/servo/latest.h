// Latest<T> under the servo's roof; it lives beside the folders because devices use it too.
#pragma once

#include "haptics/latest.h"
