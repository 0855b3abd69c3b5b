"""kerrd rays --trace: one ray step by step, the same in every form."""
import csv
import io
import json

from support import Case, main

RAY = ["rays", "--trace", "--ray=-3.75,1", "--spin", "0.9", "--inclination-deg", "70", "--precision", "f32", "--steps", "8",
       "--orders", "2"]


class Trace(Case):
    def test_the_same_in_every_form(self):
        for engine, columns in ("mino-rkn6", "time,r,w,dw,u,du,n_x,n_y,phi,delay,res_w,res_u,res_n,res_dn,res_l"), \
                ("mino-rkn4", None), ("ks-rk4", "time,r,u,phi,x,y,z,p_x,p_y,p_z,res_null,res_l"):
            with self.subTest(engine):
                found = json.loads(self.good(*RAY, "--engine", engine, "--format", "json"))
                text = self.good(*RAY, "--engine", engine, "-o", "-", "--format", "csv").decode()
                rows = list(csv.DictReader(io.StringIO(text)))
                if columns:
                    self.assertEqual(text.splitlines()[0], "number,stage,order," + columns)
                self.assertEqual((found["engine"], found["same_without_trace"], found["not_shown"]), (engine, True, 0))
                self.assertEqual(len(found["steps"]), len(rows))
                for step, row in zip(found["steps"], rows):
                    self.assertEqual({k: v if k == "stage" else float(v) for k, v in row.items() if v}, step)
                lines = self.good(*RAY, "--engine", engine).decode().splitlines()
                self.assertEqual(len(lines), len(rows) + 4)
                self.assertIn("bit for bit", lines[-1])
                self.assertEqual([line.split()[:3] for line in lines[2:-2]],
                                 [[row["number"], row["stage"], row["order"]] for row in rows])

    def test_ends_as_without(self):
        plain = json.loads(self.good(*[word for word in RAY if word != "--trace"], "--engine", "mino-rkn6"))["rays"][0]
        told = json.loads(self.good(*RAY, "-o", "-", "--format", "json"))
        self.assertEqual((told["fate"], told["crossings"], told["error"]), (plain["fate"], len(plain["crossings"]), plain["error"]))
        crossings = [step for step in told["steps"] if step["stage"] == "crossing"]
        for step, crossing in zip(crossings, plain["crossings"]):
            for name in "order", "r", "phi", "delay":
                self.assertEqual(step[name], crossing[name])

    def test_to_a_file(self):
        self.assertEqual(self.good(*RAY, "-o", self.path("a.csv")), b"")
        self.assertTrue(self.read("a.csv").startswith(b"number,stage"))
        self.assertEqual(self.good(*RAY, "-o", self.path("a.json")), b"")
        self.assertEqual(json.loads(self.read("a.json"))["precision"], "f32")

    def test_refused(self):
        self.bad(2, "(at /rays)", *RAY, "--ray", "1,2")
        self.bad(2, "no steps", *RAY[:7], "--engine", "closed")
        self.bad(2, "not npy", *RAY, "--format", "npy")
        self.bad(2, "only --trace", "rays", "--ray", "1,2", "--format", "text")
        self.bad(2, "(at /spin)", *RAY, "--spin", "2")
        with open("/dev/full", "wb") as full:
            self.bad(1, "No space left", *RAY, stdout=full)


if __name__ == "__main__":
    main(needs_device=True)
