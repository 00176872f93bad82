#pragma once
/// The whole of the API: docs/api.md.

#include "assets.h"
#include "convert.h"
#include "diagnose.h"
#include "error.h"
#include "export.h"
#include "fit.h"
#include "loop.h"
#include "measurement_set.h"
#include "plan.h"
#include "progress.h"
#include "regress.h"
#include "result.h"
#include "run.h"
#include "scaffold.h"
#include "sweep.h"
#include "version.h"
