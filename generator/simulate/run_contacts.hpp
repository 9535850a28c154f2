// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What a run needs of the contacts and events of a scene (alembert/hybrid/hybrid_motion.hpp).
///
///     const ContactView view(mechanism);
///     const KickView kicks(mechanism, scene);
///     const Contacts contacts = contacts_of(derived, start, view, kicks);
///     follow(contacts, modes, initial, options);

#include "alembert/hybrid/contact_transition.hpp"
#include "analysis/contact/contacts.hpp"
#include "analysis/contact/kicks.hpp"
#include "analysis/derive/derived.hpp"
#include "program/lower/start.hpp"

namespace alembert {

/// Whether rates may jump or zeros are counted: the mechanism has contacts, or events that do something.
bool has_jumps(const Mechanism& mechanism);

/// Contacts and events in the form that the runtime needs: gaps, rows and impulses by interpretation. The views
/// must outlive the result. Throws ModelError if the state has speeds with which motions with jumps are not
/// supported.
Contacts contacts_of(const Derived& derived, const Start& start, const ContactView& view, const KickView& kicks);

}  // namespace alembert
