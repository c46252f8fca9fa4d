//! The inputs of the controller.

use super::Data;
use crate::variables::Table;
use crate::variables::declare::declare;

/// Declares the inputs. None takes a derivative: the controller reads them at communication points.
pub(super) fn declare(table: &mut Table<Data>) {
    declare! { table.input(), Data;
        "external_reference.x" [METRE] "Wanted position of the end effector, to the right"
            |d, _| d.inputs.position.x;
        "external_reference.y" [METRE] "Wanted position of the end effector, upwards"
            |d, _| d.inputs.position.y;
        "external_reference.vx" [METRE_PER_SECOND] "Wanted velocity of the end effector, to the right"
            |d, _| d.inputs.velocity.x;
        "external_reference.vy" [METRE_PER_SECOND] "Wanted velocity of the end effector, upwards"
            |d, _| d.inputs.velocity.y;
        "external_reference.ax" [METRE_PER_SECOND2] "Wanted acceleration of the end effector, to the right"
            |d, _| d.inputs.acceleration.x;
        "external_reference.ay" [METRE_PER_SECOND2] "Wanted acceleration of the end effector, upwards"
            |d, _| d.inputs.acceleration.y;
    }
}
