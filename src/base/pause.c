#include "base/pause.h"

_Thread_local void (*kd_pause_hook)(void);
