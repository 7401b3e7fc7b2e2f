// What is known of the point under the pointer, and of a block.

import { principal } from "./fields";
import { plain, quantity } from "./numbers";
import { numbersAt, Picked } from "./pick";
import { Layout } from "./picture";
import { CONTACT_STATES, Run } from "./run";

export type Row = [string, string];

function stressRows([sxx, syy, sxy]: ArrayLike<number> & Iterable<number>): Row[] {
  const { s1, s2, angle } = principal(sxx, syy, sxy), pa = (value: number) => quantity(value, "Pa");
  return [
    ["σxx, σyy", pa(sxx) + ", " + pa(syy)],
    ["σxy", pa(sxy)],
    ["σ₁, σ₂", pa(s1) + ", " + pa(s2)],
    ["σ₁ from x", plain((angle * 180) / Math.PI) + "°"],
  ];
}

/** Of a point in a block. \param x, y  relative to the run's centre, where it is drawn */
export function pointRows(run: Run, layout: Layout, picked: Picked, smooth: boolean): Row[] {
  const { moment } = layout, { head } = run, { shape } = moment;
  const rows: Row[] = [];
  let x = 0, y = 0;
  picked.corners.forEach((corner, i) => {
    const place = 2 * shape.cornerPlace[corner];
    x += picked.weights[i] * (shape.reference[place] + moment.displacement[place]);
    y += picked.weights[i] * (shape.reference[place + 1] + moment.displacement[place + 1]);
  });
  rows.push(["x, y", `${plain(x + head.centre[0], 4)}, ${plain(y + head.centre[1], 4)} m`]);
  for (const [source, name, unit] of [["displacement", "u", "m"], ["velocity", "v", "m/s"]] as const) {
    if (!head.arrays[source]) continue;
    const [a, b] = numbersAt(moment, picked, source, smooth);
    rows.push([name + "x, " + name + "y", quantity(a, unit) + ", " + quantity(b, unit)]);
  }
  if (moment.stress) rows.push(...stressRows(numbersAt(moment, picked, "stress", smooth)));
  return rows;
}

export function contactRows(run: Run, layout: Layout, contact: number): Row[] {
  const { moment } = layout, { contacts, state, force, gap } = moment;
  return [
    ["contact", run.blockName(layout.blockOfPlace(contacts.place[contact])) + " on " + run.blockName(contacts.edgeBlock[contact])],
    ["state", CONTACT_STATES[state[contact]]],
    ["normal force", quantity(force[2 * contact], "N/m")],
    ["shear force", quantity(force[2 * contact + 1], "N/m")],
    ["gap", quantity(gap[contact], "m")],
  ];
}

/** Of a whole block, with its joints. */
export function blockRows(run: Run, layout: Layout, block: number): Row[] {
  const { moment } = layout, { shape } = moment, { head } = run, rows: Row[] = [];
  rows.push(["material", head.materials[shape.material[block]] ?? ""]);
  const first = shape.firstPlace[block], n = shape.nVertices[block], cells = shape.firstCell[block + 1] - shape.firstCell[block];
  rows.push(["vertices, cells", `${n}, ${cells}`]);
  for (const [values, name, unit] of [[head.arrays.displacement ? moment.displacement : null, "u", "m"], [moment.velocity, "v", "m/s"]] as const) {
    if (!values) continue;
    let a = 0, b = 0;
    for (let p = first; p < first + n; ++p) {
      a += values[2 * p] / n;
      b += values[2 * p + 1] / n;
    }
    rows.push(["mean " + name + "x, " + name + "y", quantity(a, unit) + ", " + quantity(b, unit)]);
  }
  const mean = layout.meanStress(block);
  if (mean) rows.push(...stressRows(mean));
  for (const joint of layout.joints) {
    if (joint.first !== block && joint.second !== block) continue;
    const other = joint.first === block ? joint.second : joint.first;
    const states = [...new Set(joint.contacts.map((k) => CONTACT_STATES[moment.state[k]]))].join(", ");
    rows.push(["joint with " + run.blockName(other), states + ", " + quantity(Math.hypot(joint.fx, joint.fy), "N/m")]);
  }
  return rows;
}
