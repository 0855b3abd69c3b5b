#include "base/pause.h"

_Thread_local bool (*kd_pause_hook)(void);
