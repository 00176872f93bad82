#pragma once
/// From the files of a tire and a rig to a wheel for another simulator.

#include "fmu/wheel_model.h"
#include "models/tire/tire_file.h"
#include "rigs/rig_file.h"

namespace rollrig::exports {

/// A tire on a rig or the road, soaked in the rig's air. Its load and cold pressure at the start are those of its
/// [iso_28580], else the references of its law. Effects take the usual values of their parameters.
/// Errors  InputError: the tire lacks a table or conductances; an unknown effect
fmu::WheelModel make_wheel_model(const models::TireFile& tire, const rigs::RigFile& rig,
                                 const std::vector<std::string>& effects);

}  // namespace rollrig::exports
