<?xml version="1.0" encoding="utf-8"?>
<!-- SPDX-License-Identifier: LGPL-2.1-or-later -->
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
  <context>
    <name>App::Property</name>
    <message>
      <source>1 Lattice</source>
      <translation>1 Gitter</translation>
    </message>
    <message>
      <source>2 Skin</source>
      <translation>2 Haut</translation>
    </message>
    <message>
      <source>2 to 8; empty ones are left out</source>
      <translation>2 bis 8; leere fallen weg</translation>
    </message>
    <message>
      <source>3 Grading</source>
      <translation>3 Verlauf</translation>
    </message>
    <message>
      <source>4 Print</source>
      <translation>4 Druck</translation>
    </message>
    <message>
      <source>5 Result</source>
      <translation>5 Ergebnis</translation>
    </message>
    <message>
      <source>6 Advanced</source>
      <translation>6 Erweitert</translation>
    </message>
    <message>
      <source>A field that the density of the points follows in place of the depth: s is 0 at its smallest value and 1 at its largest (files as of a radius field, of one column)</source>
      <translation>Ein Feld, dem die Dichte der Punkte statt der Tiefe folgt: s ist 0 bei seinem kleinsten Wert und 1 bei seinem größten (Dateien wie für ein Radiusfeld, mit einer Spalte)</translation>
    </message>
    <message>
      <source>A point of the axis, or the centre</source>
      <translation>Ein Punkt der Achse, oder der Mittelpunkt</translation>
    </message>
    <message>
      <source>A point that is to be a corner of a cell; of a network of a file, where its own origin is to lie</source>
      <translation>Ein Punkt, der Ecke einer Zelle sein soll; bei einem Netz aus einer Datei: wo deren Nullpunkt liegen soll</translation>
    </message>
    <message>
      <source>Activation</source>
      <translation>Aktivierung</translation>
    </message>
    <message>
      <source>All figures of the last update, as JSON</source>
      <translation>Alle Zahlen der letzten Aktualisierung, als JSON</translation>
    </message>
    <message>
      <source>All figures, as JSON</source>
      <translation>Alle Zahlen, als JSON</translation>
    </message>
    <message>
      <source>All figures, for people</source>
      <translation>Alle Zahlen, zum Lesen</translation>
    </message>
    <message>
      <source>Along this direction of the cell: 1,0,0 along its edges, 1,1,0 across its faces, 1,1,1 along its diagonals</source>
      <translation>Entlang dieser Richtung der Zelle: 1,0,0 längs ihrer Kanten, 1,1,0 quer über ihre Flächen, 1,1,1 längs ihrer Diagonalen</translation>
    </message>
    <message>
      <source>Along which the density changes, in the document's coordinates</source>
      <translation>Entlang derer sich die Dichte ändert, in den Koordinaten des Dokuments</translation>
    </message>
    <message>
      <source>Another seed draws other points</source>
      <translation>Ein anderer Startwert zieht andere Punkte</translation>
    </message>
    <message>
      <source>Auto Update</source>
      <translation>Automatisch aktualisieren</translation>
    </message>
    <message>
      <source>Axis that the cells lie about</source>
      <translation>Achse, um die die Zellen liegen</translation>
    </message>
    <message>
      <source>Band Densities</source>
      <translation>Dichten der Bänder</translation>
    </message>
    <message>
      <source>Band Volumes</source>
      <translation>Volumen der Bänder</translation>
    </message>
    <message>
      <source>Bands</source>
      <translation>Bänder</translation>
    </message>
    <message>
      <source>Base</source>
      <translation>Basis</translation>
    </message>
    <message>
      <source>Between struts that do not meet, mm</source>
      <translation>Zwischen Streben, die sich nicht treffen, mm</translation>
    </message>
    <message>
      <source>Bodies</source>
      <translation>Körper</translation>
    </message>
    <message>
      <source>Bottom Layers</source>
      <translation>Bodenschichten</translation>
    </message>
    <message>
      <source>Boundary</source>
      <translation>Rand</translation>
    </message>
    <message>
      <source>Build Direction</source>
      <translation>Baurichtung</translation>
    </message>
    <message>
      <source>By how many mm a skeleton or complement is thicker than up to the surface; negative for a thinner one</source>
      <translation>Um wie viele mm ein Gerüst oder sein Gegenstück dicker ist als bis zur Fläche; negativ für dünner</translation>
    </message>
    <message>
      <source>CSV or VTK file of points and values</source>
      <translation>CSV- oder VTK-Datei mit Punkten und Werten</translation>
    </message>
    <message>
      <source>Cartesian</source>
      <translation>Kartesisch</translation>
    </message>
    <message>
      <source>Cell Edges</source>
      <translation>Zellkanten</translation>
    </message>
    <message>
      <source>Cell File</source>
      <translation>Zelldatei</translation>
    </message>
    <message>
      <source>Cell Map</source>
      <translation>Zellanordnung</translation>
    </message>
    <message>
      <source>Cell Size</source>
      <translation>Zellgröße</translation>
    </message>
    <message>
      <source>Cell Type</source>
      <translation>Zelltyp</translation>
    </message>
    <message>
      <source>Cell Values</source>
      <translation>Zellenwerte</translation>
    </message>
    <message>
      <source>Cell map</source>
      <translation>Zellanordnung</translation>
    </message>
    <message>
      <source>Cell size</source>
      <translation>Zellgröße</translation>
    </message>
    <message>
      <source>Cells</source>
      <translation>Zellen</translation>
    </message>
    <message>
      <source>Cells Active</source>
      <translation>Aktive Zellen</translation>
    </message>
    <message>
      <source>Cells Total</source>
      <translation>Zellen gesamt</translation>
    </message>
    <message>
      <source>Cells along straight axes, about an axis, or about a centre</source>
      <translation>Zellen entlang gerader Achsen, um eine Achse oder um einen Mittelpunkt</translation>
    </message>
    <message>
      <source>Cells around the full turn; 0 for as many as make them L wide half-way out</source>
      <translation>Zellen auf dem vollen Umfang; 0 für so viele, dass sie auf halbem Radius L breit sind</translation>
    </message>
    <message>
      <source>Cells grow along it</source>
      <translation>Entlang dieser Richtung wachsen die Zellen</translation>
    </message>
    <message>
      <source>Cells in the grid</source>
      <translation>Zellen des Rasters</translation>
    </message>
    <message>
      <source>Cells that grow along a direction: the profile of lambda (section 2.5 of the method)</source>
      <translation>Zellen, die entlang einer Richtung wachsen: das Profil von Lambda (Abschnitt 2.5 der Methode)</translation>
    </message>
    <message>
      <source>Cells that hold a lattice</source>
      <translation>Zellen, die Gitter enthalten</translation>
    </message>
    <message>
      <source>Centre</source>
      <translation>Mitte</translation>
    </message>
    <message>
      <source>Closed cavities</source>
      <translation>Geschlossene Hohlräume</translation>
    </message>
    <message>
      <source>Closed voids, which would trap powder or resin</source>
      <translation>Geschlossene Hohlräume, die Pulver oder Harz einschließen würden</translation>
    </message>
    <message>
      <source>Colour of the lattice inside the skin</source>
      <translation>Farbe des Gitters in der Haut</translation>
    </message>
    <message>
      <source>Complement</source>
      <translation>Gegenstück</translation>
    </message>
    <message>
      <source>Compute at every change; switch it off for large jobs and use Update Lattice Infill</source>
      <translation>Bei jeder Änderung rechnen; bei großen Aufgaben ausschalten und Gitterfüllung aktualisieren verwenden</translation>
    </message>
    <message>
      <source>Computing time of the last update</source>
      <translation>Rechenzeit der letzten Aktualisierung</translation>
    </message>
    <message>
      <source>Core</source>
      <translation>Kern</translation>
    </message>
    <message>
      <source>Curve</source>
      <translation>Kurve</translation>
    </message>
    <message>
      <source>Custom</source>
      <translation>Eigene</translation>
    </message>
    <message>
      <source>Cylindrical</source>
      <translation>Zylindrisch</translation>
    </message>
    <message>
      <source>Dangling Removed</source>
      <translation>Lose Streben entfernt</translation>
    </message>
    <message>
      <source>Delaunay</source>
      <translation>Delaunay</translation>
    </message>
    <message>
      <source>Density</source>
      <translation>Dichte</translation>
    </message>
    <message>
      <source>Density End</source>
      <translation>Dichte am Ende</translation>
    </message>
    <message>
      <source>Density Start</source>
      <translation>Dichte am Anfang</translation>
    </message>
    <message>
      <source>Density of the material in g/cm3</source>
      <translation>Dichte des Werkstoffs in g/cm3</translation>
    </message>
    <message>
      <source>Density of the points as a formula of s, 0 at the wall and 1 at the deepest place, such as '3 - 2 * s'; empty for an even one</source>
      <translation>Dichte der Punkte als Formel von s, 0 an der Wand und 1 an der tiefsten Stelle, etwa '3 - 2 * s'; leer für eine gleichmäßige</translation>
    </message>
    <message>
      <source>Depth at which the grading ends, for the grading over the depth</source>
      <translation>Tiefe, in der die Gradierung endet, für die Gradierung über die Tiefe</translation>
    </message>
    <message>
      <source>Depth at which the profile ends</source>
      <translation>Tiefe, in der das Profil endet</translation>
    </message>
    <message>
      <source>Designs</source>
      <translation>Entwürfe</translation>
    </message>
    <message>
      <source>Designs and their figures, as JSON</source>
      <translation>Entwürfe und ihre Zahlen, als JSON</translation>
    </message>
    <message>
      <source>Designs with figures</source>
      <translation>Entwürfe mit Zahlen</translation>
    </message>
    <message>
      <source>Deviation</source>
      <translation>Abweichung</translation>
    </message>
    <message>
      <source>Diameter of the holes that let powder or resin out of the skin; 0 for none</source>
      <translation>Durchmesser der Löcher, die Pulver oder Harz aus der Haut lassen; 0 für keine</translation>
    </message>
    <message>
      <source>Direction</source>
      <translation>Richtung</translation>
    </message>
    <message>
      <source>Distance from the faces of KeepSolidAround up to which the part stays solid</source>
      <translation>Abstand von den Flächen in KeepSolidAround, bis zu dem das Teil massiv bleibt</translation>
    </message>
    <message>
      <source>Domain</source>
      <translation>Füllraum</translation>
    </message>
    <message>
      <source>Drain Count</source>
      <translation>Anzahl der Löcher</translation>
    </message>
    <message>
      <source>Drain Diameter</source>
      <translation>Lochdurchmesser</translation>
    </message>
    <message>
      <source>Drain Faces</source>
      <translation>Gelochte Flächen</translation>
    </message>
    <message>
      <source>Drain Holes</source>
      <translation>Entleerungslöcher</translation>
    </message>
    <message>
      <source>Drain Points</source>
      <translation>Lochpunkte</translation>
    </message>
    <message>
      <source>Even Density</source>
      <translation>Gleichmäßige Dichte</translation>
    </message>
    <message>
      <source>Every edge is shared by exactly two triangles</source>
      <translation>Jede Kante gehört zu genau zwei Dreiecken</translation>
    </message>
    <message>
      <source>Expected</source>
      <translation>Erwartet</translation>
    </message>
    <message>
      <source>Exponential</source>
      <translation>Exponentiell</translation>
    </message>
    <message>
      <source>FEM result, or lattice infill that was sized for loads</source>
      <translation>FEM-Ergebnis, oder Gitterfüllung, die für Lasten bemessen wurde</translation>
    </message>
    <message>
      <source>Faces</source>
      <translation>Flächen</translation>
    </message>
    <message>
      <source>Faces in the middle of which holes are drilled</source>
      <translation>Flächen, in deren Mitte Löcher gebohrt werden</translation>
    </message>
    <message>
      <source>Faces of the solid that have no skin: the cavity opens there, struts are cut flush</source>
      <translation>Flächen des Volumenkörpers ohne Haut: dort öffnet sich der Hohlraum, Streben sind bündig geschnitten</translation>
    </message>
    <message>
      <source>Faces of the solid whose skin has a thickness of its own, each with its number in SkinThicknesses</source>
      <translation>Flächen des Körpers, deren Haut eine eigene Dicke hat, jede mit ihrer Zahl in SkinThicknesses</translation>
    </message>
    <message>
      <source>Faces round which the part stays solid, up to KeepDistance, and solids whose room in it does</source>
      <translation>Flächen, um die das Teil bis KeepDistance massiv bleibt, und Körper, deren Raum darin massiv bleibt</translation>
    </message>
    <message>
      <source>Facets</source>
      <translation>Facetten</translation>
    </message>
    <message>
      <source>Facets along the edge of a cell; 0 to choose it by the deviation</source>
      <translation>Facetten entlang der Kante einer Zelle; 0, um sie nach der Abweichung zu wählen</translation>
    </message>
    <message>
      <source>Field</source>
      <translation>Feld</translation>
    </message>
    <message>
      <source>Field Column</source>
      <translation>Spalte des Felds</translation>
    </message>
    <message>
      <source>Field File</source>
      <translation>Feld-Datei</translation>
    </message>
    <message>
      <source>Field Object</source>
      <translation>Feld-Objekt</translation>
    </message>
    <message>
      <source>Filament</source>
      <translation>Filament</translation>
    </message>
    <message>
      <source>Filament Volume</source>
      <translation>Filamentvolumen</translation>
    </message>
    <message>
      <source>File</source>
      <translation>Datei</translation>
    </message>
    <message>
      <source>File of points and thicknesses of the skin, which it follows below all other faces, nowhere thinner than the shell</source>
      <translation>Datei mit Punkten und Dicken der Haut, denen sie unter allen anderen Flächen folgt, nirgends dünner als die Hautdicke</translation>
    </message>
    <message>
      <source>File of points and values: .csv, .txt, .vtu, .vtk</source>
      <translation>Datei mit Punkten und Werten: .csv, .txt, .vtu, .vtk</translation>
    </message>
    <message>
      <source>Fill</source>
      <translation>Füllen</translation>
    </message>
    <message>
      <source>Findings</source>
      <translation>Befunde</translation>
    </message>
    <message>
      <source>Folder</source>
      <translation>Ordner</translation>
    </message>
    <message>
      <source>Follows</source>
      <translation>Folgt</translation>
    </message>
    <message>
      <source>For which the project is written</source>
      <translation>Für den das Projekt geschrieben wird</translation>
    </message>
    <message>
      <source>Formula</source>
      <translation>Formel</translation>
    </message>
    <message>
      <source>From the build plate up</source>
      <translation>Von der Bauplatte nach oben</translation>
    </message>
    <message>
      <source>From the build plate up, in the document's coordinates</source>
      <translation>Von der Bauplatte nach oben, in den Koordinaten des Dokuments</translation>
    </message>
    <message>
      <source>Genus</source>
      <translation>Geschlecht</translation>
    </message>
    <message>
      <source>Grading Direction</source>
      <translation>Gradierungsrichtung</translation>
    </message>
    <message>
      <source>Holes for each void that is still closed, at its lowest places along the build direction</source>
      <translation>Löcher für jeden noch geschlossenen Hohlraum, an seinen tiefsten Stellen entlang der Baurichtung</translation>
    </message>
    <message>
      <source>How it will be printed</source>
      <translation>Wie es gedruckt wird</translation>
    </message>
    <message>
      <source>How many layers of cells lie upon a surface or between two; 0 for as many as come nearest to the cell size</source>
      <translation>Wie viele Lagen von Zellen auf einer Fläche oder zwischen zweien liegen; 0 für so viele, wie der Zellgröße am nächsten kommen</translation>
    </message>
    <message>
      <source>How many points lie in the part; 0 for as many as lie a cell size apart</source>
      <translation>Wie viele Punkte im Teil liegen; 0 für so viele, dass sie eine Zellengröße auseinander liegen</translation>
    </message>
    <message>
      <source>How often each point moves to the middle of its cell, which evens them out</source>
      <translation>Wie oft jeder Punkt in die Mitte seiner Zelle rückt, was sie gleichmäßiger macht</translation>
    </message>
    <message>
      <source>How the part is printed: its limits are those of the print check</source>
      <translation>Wie das Teil gedruckt wird: die Grenzen des Verfahrens sind die der Druckprüfung</translation>
    </message>
    <message>
      <source>Infill</source>
      <translation>Füllung</translation>
    </message>
    <message>
      <source>Inside</source>
      <translation>Innen</translation>
    </message>
    <message>
      <source>Internal</source>
      <translation>Intern</translation>
    </message>
    <message>
      <source>Its density gives the mass</source>
      <translation>Seine Dichte gibt die Masse</translation>
    </message>
    <message>
      <source>Joint Fillet</source>
      <translation>Knotenausrundung</translation>
    </message>
    <message>
      <source>Keep Distance</source>
      <translation>Abstand massiv</translation>
    </message>
    <message>
      <source>Keep Pieces</source>
      <translation>Lose Teile behalten</translation>
    </message>
    <message>
      <source>Keep Radius</source>
      <translation>Radius beibehalten</translation>
    </message>
    <message>
      <source>Keep Solid Around</source>
      <translation>Massiv lassen um</translation>
    </message>
    <message>
      <source>Keep pieces of the lattice that hang on nothing; otherwise they are left out, and told</source>
      <translation>Teile des Gitters behalten, die an nichts hängen; sonst werden sie weggelassen und gemeldet</translation>
    </message>
    <message>
      <source>L: edge length of the cubic cell</source>
      <translation>L: Kantenlänge der würfelförmigen Zelle</translation>
    </message>
    <message>
      <source>Lambda End</source>
      <translation>Lambda am Ende</translation>
    </message>
    <message>
      <source>Lambda Formula</source>
      <translation>Lambda-Formel</translation>
    </message>
    <message>
      <source>Lambda Start</source>
      <translation>Lambda am Anfang</translation>
    </message>
    <message>
      <source>Largest Ball</source>
      <translation>Größte Kugel</translation>
    </message>
    <message>
      <source>Largest distance between a facet and the exact struts and joints, kept within 1.5 times; 0 for a thirty-fifth of the radius</source>
      <translation>Größter Abstand zwischen einer Facette und den genauen Streben und Knoten, auf das 1,5-fache eingehalten; 0 für ein Fünfunddreißigstel des Radius</translation>
    </message>
    <message>
      <source>Lattice</source>
      <translation>Gitter</translation>
    </message>
    <message>
      <source>Layer Height</source>
      <translation>Schichthöhe</translation>
    </message>
    <message>
      <source>Layers upon one surface lie on its other side, against its normals</source>
      <translation>Lagen auf einer Fläche liegen auf ihrer anderen Seite, gegen ihre Normalen</translation>
    </message>
    <message>
      <source>Least thickness of walls, mm</source>
      <translation>Kleinste Dicke von Wänden, mm</translation>
    </message>
    <message>
      <source>Length of the longest strut of these</source>
      <translation>Länge der längsten dieser Streben</translation>
    </message>
    <message>
      <source>Limits</source>
      <translation>Grenzen</translation>
    </message>
    <message>
      <source>Line Width</source>
      <translation>Linienbreite</translation>
    </message>
    <message>
      <source>Linear</source>
      <translation>Linear</translation>
    </message>
    <message>
      <source>Lines side by side</source>
      <translation>Linien nebeneinander</translation>
    </message>
    <message>
      <source>Longest Overhang</source>
      <translation>Längster Überhang</translation>
    </message>
    <message>
      <source>Loose fragments that were dropped</source>
      <translation>Lose Bruchstücke, die entfernt wurden</translation>
    </message>
    <message>
      <source>Make and measure every design, too</source>
      <translation>Jeden Entwurf auch herstellen und messen</translation>
    </message>
    <message>
      <source>Map Around</source>
      <translation>Zellen am Umfang</translation>
    </message>
    <message>
      <source>Map Axis</source>
      <translation>Achse der Anordnung</translation>
    </message>
    <message>
      <source>Map Centre</source>
      <translation>Mittelpunkt der Anordnung</translation>
    </message>
    <message>
      <source>Mass</source>
      <translation>Masse</translation>
    </message>
    <message>
      <source>Mass in g at the given density</source>
      <translation>Masse in g bei der angegebenen Dichte</translation>
    </message>
    <message>
      <source>Mass of the finished part, with its skin</source>
      <translation>Masse des fertigen Teils, mit seiner Haut</translation>
    </message>
    <message>
      <source>Material</source>
      <translation>Werkstoff</translation>
    </message>
    <message>
      <source>Material File</source>
      <translation>Werkstoffdatei</translation>
    </message>
    <message>
      <source>Material Price</source>
      <translation>Materialpreis</translation>
    </message>
    <message>
      <source>Mean of the field in each band, percent</source>
      <translation>Mittel des Felds in jedem Band, Prozent</translation>
    </message>
    <message>
      <source>Mesh</source>
      <translation>Netz</translation>
    </message>
    <message>
      <source>Narrowest Gap</source>
      <translation>Engster Spalt</translation>
    </message>
    <message>
      <source>Network</source>
      <translation>Netzwerk</translation>
    </message>
    <message>
      <source>Network Angle</source>
      <translation>Netzwerk: Winkel</translation>
    </message>
    <message>
      <source>Network Density</source>
      <translation>Netzwerk: Dichte</translation>
    </message>
    <message>
      <source>Network Faces</source>
      <translation>Netzwerk: Flächen</translation>
    </message>
    <message>
      <source>Network Field</source>
      <translation>Netzwerk: Feld</translation>
    </message>
    <message>
      <source>Network File</source>
      <translation>Netzwerk: Datei</translation>
    </message>
    <message>
      <source>Network Layers</source>
      <translation>Netzwerk: Lagen</translation>
    </message>
    <message>
      <source>Network On Wall</source>
      <translation>Netzwerk auf der Haut</translation>
    </message>
    <message>
      <source>Network Points</source>
      <translation>Netzwerk: Punkte</translation>
    </message>
    <message>
      <source>Network Relax</source>
      <translation>Netzwerk: Ausgleich</translation>
    </message>
    <message>
      <source>Network Reversed</source>
      <translation>Netzwerk umgekehrt</translation>
    </message>
    <message>
      <source>Network Seed</source>
      <translation>Netzwerk: Startwert</translation>
    </message>
    <message>
      <source>Network Shortest</source>
      <translation>Netzwerk: kürzeste Strebe</translation>
    </message>
    <message>
      <source>Network Thickness</source>
      <translation>Netzwerk: Dicke</translation>
    </message>
    <message>
      <source>Nodes</source>
      <translation>Knoten</translation>
    </message>
    <message>
      <source>Nodes and struts: .json, .csv, lines of .obj or .vtk, beams of .3mf; or a mesh (.vtk, .vtu, .inp, .msh, .obj) whose hexahedra the cell is laid into, on whose quadrilaterals layers of it lie, or whose tetrahedra's edges are struts</source>
      <translation>Knoten und Streben: .json, .csv, Linien aus .obj oder .vtk, Streben aus .3mf; oder ein Netz (.vtk, .vtu, .inp, .msh, .obj), in dessen Hexaeder die Zelle gelegt wird, auf dessen Vierecken sie in Lagen liegt oder dessen Tetraederkanten Streben sind</translation>
    </message>
    <message>
      <source>Nodes of the lattice before trimming</source>
      <translation>Knoten des Gitters vor dem Beschneiden</translation>
    </message>
    <message>
      <source>None</source>
      <translation>Ohne</translation>
    </message>
    <message>
      <source>Numbers that the cell leaves to be chosen, such as 'arm = 0.15' of Re-entrant; 'volfrep cells' tells which</source>
      <translation>Zahlen, die die Zelle zur Wahl lässt, etwa 'arm = 0.15' bei Re-entrant; 'volfrep cells' sagt, welche</translation>
    </message>
    <message>
      <source>Of a layer</source>
      <translation>Einer Schicht</translation>
    </message>
    <message>
      <source>Of all that is extruded</source>
      <translation>Von allem, was extrudiert wird</translation>
    </message>
    <message>
      <source>Of an extruded line</source>
      <translation>Einer extrudierten Linie</translation>
    </message>
    <message>
      <source>Of the facets that hang over: this object's mesh</source>
      <translation>Der überhängenden Facetten: das Netz dieses Objekts</translation>
    </message>
    <message>
      <source>Of the filament, g</source>
      <translation>Des Filaments, g</translation>
    </message>
    <message>
      <source>Of the layers of cells upon one surface together</source>
      <translation>Der Lagen von Zellen auf einer Fläche zusammen</translation>
    </message>
    <message>
      <source>Of the mesh: the solid's, then each band's</source>
      <translation>Des Netzes: die des Körpers, dann die jedes Bands</translation>
    </message>
    <message>
      <source>Of the part</source>
      <translation>Des Bauteils</translation>
    </message>
    <message>
      <source>Of the part, g</source>
      <translation>Des Bauteils, g</translation>
    </message>
    <message>
      <source>Of the process, and their source</source>
      <translation>Des Verfahrens, mit ihrer Quelle</translation>
    </message>
    <message>
      <source>Of the solid</source>
      <translation>Des Körpers</translation>
    </message>
    <message>
      <source>Of the struts' length, too flat</source>
      <translation>Der Strebenlänge, zu flach</translation>
    </message>
    <message>
      <source>Of two struts that meet at less than so many degrees the longer one goes</source>
      <translation>Von zwei Streben, die sich unter weniger Grad treffen, fällt der längere weg</translation>
    </message>
    <message>
      <source>Of walls and solid layers</source>
      <translation>Von Wänden und vollen Schichten</translation>
    </message>
    <message>
      <source>Open Faces</source>
      <translation>Offene Flächen</translation>
    </message>
    <message>
      <source>Openings</source>
      <translation>Öffnungen</translation>
    </message>
    <message>
      <source>Orientation</source>
      <translation>Ausrichtung</translation>
    </message>
    <message>
      <source>Origin</source>
      <translation>Ursprung</translation>
    </message>
    <message>
      <source>Output</source>
      <translation>Ausgabe</translation>
    </message>
    <message>
      <source>Overhang Area</source>
      <translation>Überhangfläche</translation>
    </message>
    <message>
      <source>Overhang Share</source>
      <translation>Überhanganteil</translation>
    </message>
    <message>
      <source>Part</source>
      <translation>Bauteil</translation>
    </message>
    <message>
      <source>Pattern</source>
      <translation>Muster</translation>
    </message>
    <message>
      <source>Percent at the end: at the skin, or where the field is largest</source>
      <translation>Prozent am Ende: an der Haut, oder wo das Feld am größten ist</translation>
    </message>
    <message>
      <source>Percent at the start: deep inside, or where the field is smallest</source>
      <translation>Prozent am Anfang: tief innen, oder wo das Feld am kleinsten ist</translation>
    </message>
    <message>
      <source>Percent of x, y and z in mm, such as 10 + z</source>
      <translation>Prozent aus x, y und z in mm, etwa 10 + z</translation>
    </message>
    <message>
      <source>Pieces Removed</source>
      <translation>Teile entfernt</translation>
    </message>
    <message>
      <source>Points where holes are drilled</source>
      <translation>Punkte, an denen Löcher gebohrt werden</translation>
    </message>
    <message>
      <source>Price of a kilogram of the material in your currency, for the cost in the panel; 0 for not known</source>
      <translation>Preis eines Kilogramms des Materials in Ihrer Währung, für die Kosten im Fenster; 0 für unbekannt</translation>
    </message>
    <message>
      <source>Print</source>
      <translation>Druck</translation>
    </message>
    <message>
      <source>Print Material</source>
      <translation>Werkstoff</translation>
    </message>
    <message>
      <source>Print Process</source>
      <translation>Druckverfahren</translation>
    </message>
    <message>
      <source>Process</source>
      <translation>Verfahren</translation>
    </message>
    <message>
      <source>Profile of the radius over s</source>
      <translation>Profil des Radius über s</translation>
    </message>
    <message>
      <source>Properties and their values: 'CellSize: 6, 8, 10' or 'ShellThickness: 1 to 3 in 5'</source>
      <translation>Eigenschaften und ihre Werte: 'CellSize: 6, 8, 10' oder 'ShellThickness: 1 to 3 in 5'</translation>
    </message>
    <message>
      <source>Put a corner of a cell at Origin; otherwise the cells start at the corner of the solid</source>
      <translation>Eine Zellecke an Origin legen; sonst beginnen die Zellen an der Ecke des Volumenkörpers</translation>
    </message>
    <message>
      <source>Put the axis through MapCentre; otherwise through the middle of the solid's box</source>
      <translation>Die Achse durch MapCentre legen; sonst durch die Mitte des Quaders um den Volumenkörper</translation>
    </message>
    <message>
      <source>Quadratic</source>
      <translation>Quadratisch</translation>
    </message>
    <message>
      <source>Radius</source>
      <translation>Radius</translation>
    </message>
    <message>
      <source>Radius Column</source>
      <translation>Wertespalte</translation>
    </message>
    <message>
      <source>Radius Curve</source>
      <translation>Radiuskurve</translation>
    </message>
    <message>
      <source>Radius Direction</source>
      <translation>Radiusrichtung</translation>
    </message>
    <message>
      <source>Radius Driven By</source>
      <translation>Radius folgt aus</translation>
    </message>
    <message>
      <source>Radius End</source>
      <translation>Radius am Ende</translation>
    </message>
    <message>
      <source>Radius Field</source>
      <translation>Radiusfeld</translation>
    </message>
    <message>
      <source>Radius Formula</source>
      <translation>Radiusformel</translation>
    </message>
    <message>
      <source>Radius Grading</source>
      <translation>Radiusgradierung</translation>
    </message>
    <message>
      <source>Radius Profile</source>
      <translation>Radiusprofil</translation>
    </message>
    <message>
      <source>Radius Reach</source>
      <translation>Reichweite</translation>
    </message>
    <message>
      <source>Radius Result</source>
      <translation>FEM-Ergebnis</translation>
    </message>
    <message>
      <source>Radius Start</source>
      <translation>Radius am Anfang</translation>
    </message>
    <message>
      <source>Radius at s = 0, or where the field is smallest; 0 for the strut radius</source>
      <translation>Radius bei s = 0, oder wo das Feld am kleinsten ist; 0 für den Strebenradius</translation>
    </message>
    <message>
      <source>Radius at s = 1, or where the field is largest; 0 for the strut radius</source>
      <translation>Radius bei s = 1, oder wo das Feld am größten ist; 0 für den Strebenradius</translation>
    </message>
    <message>
      <source>Radius in mm as a formula of s</source>
      <translation>Radius in mm als Formel von s</translation>
    </message>
    <message>
      <source>Radius of the round between struts where they meet; 0 for none</source>
      <translation>Radius der Ausrundung zwischen Streben, wo sie sich treffen; 0 für keine</translation>
    </message>
    <message>
      <source>Reach</source>
      <translation>Reichweite</translation>
    </message>
    <message>
      <source>Refused</source>
      <translation>Abgelehnt</translation>
    </message>
    <message>
      <source>Relative Density</source>
      <translation>Relative Dichte</translation>
    </message>
    <message>
      <source>Relative density</source>
      <translation>Relative Dichte</translation>
    </message>
    <message>
      <source>Remove Below</source>
      <translation>Entfernen unterhalb</translation>
    </message>
    <message>
      <source>Remove Dangling</source>
      <translation>Lose Streben weg</translation>
    </message>
    <message>
      <source>Remove Flatter</source>
      <translation>Flachere entfernen</translation>
    </message>
    <message>
      <source>Report</source>
      <translation>Bericht</translation>
    </message>
    <message>
      <source>Resolution</source>
      <translation>Auflösung</translation>
    </message>
    <message>
      <source>Result</source>
      <translation>Ergebnis</translation>
    </message>
    <message>
      <source>Result of a FEM solver, instead of a file</source>
      <translation>Ergebnis eines FEM-Lösers, anstelle einer Datei</translation>
    </message>
    <message>
      <source>Scalar</source>
      <translation>Skalar</translation>
    </message>
    <message>
      <source>Seconds</source>
      <translation>Sekunden</translation>
    </message>
    <message>
      <source>Separate pieces of material</source>
      <translation>Getrennte Teile aus Werkstoff</translation>
    </message>
    <message>
      <source>Sheet</source>
      <translation>Wand</translation>
    </message>
    <message>
      <source>Shell Thickness</source>
      <translation>Hautdicke</translation>
    </message>
    <message>
      <source>Short struts with a free end, taken away</source>
      <translation>Kurze Streben mit freiem Ende, weggenommen</translation>
    </message>
    <message>
      <source>Shortest Stub</source>
      <translation>Kürzester Stummel</translation>
    </message>
    <message>
      <source>Shortest and longest edge of a cell, mm</source>
      <translation>Kürzeste und längste Kante einer Zelle, mm</translation>
    </message>
    <message>
      <source>Shortest and longest strut, mm</source>
      <translation>Kürzeste und längste Strebe, mm</translation>
    </message>
    <message>
      <source>Size Grading</source>
      <translation>Größengradierung</translation>
    </message>
    <message>
      <source>Skeleton</source>
      <translation>Gerüst</translation>
    </message>
    <message>
      <source>Skin</source>
      <translation>Haut</translation>
    </message>
    <message>
      <source>Skin Faces</source>
      <translation>Flächen mit eigener Haut</translation>
    </message>
    <message>
      <source>Skin Field</source>
      <translation>Feld der Hautdicke</translation>
    </message>
    <message>
      <source>Skin Follows Sizing</source>
      <translation>Haut wie bemessen</translation>
    </message>
    <message>
      <source>Skin Thicknesses</source>
      <translation>Hautdicken</translation>
    </message>
    <message>
      <source>Slicer</source>
      <translation>Slicer</translation>
    </message>
    <message>
      <source>Smallest and largest strut radius, mm</source>
      <translation>Kleinster und größter Strebenradius, mm</translation>
    </message>
    <message>
      <source>Smallest diameter of a strut, mm</source>
      <translation>Kleinster Durchmesser einer Strebe, mm</translation>
    </message>
    <message>
      <source>Solid</source>
      <translation>Volumenkörper</translation>
    </message>
    <message>
      <source>Solid Volume</source>
      <translation>Volles Volumen</translation>
    </message>
    <message>
      <source>Solid ones above what looks down</source>
      <translation>Volle über dem, was nach unten sieht</translation>
    </message>
    <message>
      <source>Solid ones below what looks up</source>
      <translation>Volle unter dem, was nach oben sieht</translation>
    </message>
    <message>
      <source>Sparse infill in each band, mm3</source>
      <translation>Lockere Füllung in jedem Band, mm3</translation>
    </message>
    <message>
      <source>Spherical</source>
      <translation>Kugelförmig</translation>
    </message>
    <message>
      <source>Status</source>
      <translation>Status</translation>
    </message>
    <message>
      <source>Status Shown</source>
      <translation>Zustand</translation>
    </message>
    <message>
      <source>Stiffness</source>
      <translation>Steifigkeit</translation>
    </message>
    <message>
      <source>Stiffness Direction</source>
      <translation>Richtung der Steifigkeit</translation>
    </message>
    <message>
      <source>Strut Lengths</source>
      <translation>Strebenlängen</translation>
    </message>
    <message>
      <source>Strut Radii</source>
      <translation>Strebenradien</translation>
    </message>
    <message>
      <source>Strut Radius</source>
      <translation>Strebenradius</translation>
    </message>
    <message>
      <source>Strut radius</source>
      <translation>Strebenradius</translation>
    </message>
    <message>
      <source>Struts</source>
      <translation>Streben</translation>
    </message>
    <message>
      <source>Struts of the lattice before trimming</source>
      <translation>Streben des Gitters vor dem Beschneiden</translation>
    </message>
    <message>
      <source>Struts run along the wall, too, where it cuts the faces of the points' cells</source>
      <translation>Streben verlaufen auch auf der Haut, wo sie die Flächen der Zellen der Punkte schneidet</translation>
    </message>
    <message>
      <source>Struts shorter than this are drawn together into one node; 0 for four radii</source>
      <translation>Kürzere Streben werden zu einem Knoten zusammengezogen; 0 für vier Radien</translation>
    </message>
    <message>
      <source>Struts whose radius varies: along a direction, by the depth below the skin (s = 1 at the skin, or at the core), or by a field of values</source>
      <translation>Streben mit veränderlichem Radius: entlang einer Richtung, mit der Tiefe unter der Haut (s = 1 an der Haut oder im Kern) oder nach einem Feld von Werten</translation>
    </message>
    <message>
      <source>Struts with a free end that were taken away</source>
      <translation>Streben mit freiem Ende, die weggenommen wurden</translation>
    </message>
    <message>
      <source>Stubs Removed</source>
      <translation>Stummel entfernt</translation>
    </message>
    <message>
      <source>Study</source>
      <translation>Studie</translation>
    </message>
    <message>
      <source>Surface Area</source>
      <translation>Oberfläche</translation>
    </message>
    <message>
      <source>Table</source>
      <translation>Tabelle</translation>
    </message>
    <message>
      <source>Take away struts that are nowhere thicker than this radius; 0 for none</source>
      <translation>Streben wegnehmen, die nirgends dicker als dieser Radius sind; 0 für keine</translation>
    </message>
    <message>
      <source>Take away struts that lie flatter than so many degrees to the build plate, and those with a free end then; 0 for none</source>
      <translation>Streben wegnehmen, die flacher als so viele Grad zur Bauplatte liegen, und die dann ein freies Ende haben; 0 für keine</translation>
    </message>
    <message>
      <source>Take away struts with a free end that are shorter than this; 0 for none</source>
      <translation>Streben mit freiem Ende wegnehmen, die kürzer sind; 0 für keine</translation>
    </message>
    <message>
      <source>Take away struts with a free end, again and again until there are none</source>
      <translation>Streben mit freiem Ende wegnehmen, bis keine mehr da ist</translation>
    </message>
    <message>
      <source>Target Density</source>
      <translation>Zieldichte</translation>
    </message>
    <message>
      <source>Target Mass</source>
      <translation>Zielmasse</translation>
    </message>
    <message>
      <source>Target Stiffness</source>
      <translation>Zielsteifigkeit</translation>
    </message>
    <message>
      <source>Text</source>
      <translation>Text</translation>
    </message>
    <message>
      <source>That gets out of the lattice, mm; for powder</source>
      <translation>Die aus dem Gitter herauskommt, mm; für Pulver</translation>
    </message>
    <message>
      <source>That the slicer lays</source>
      <translation>Das der Slicer legt</translation>
    </message>
    <message>
      <source>The .json file of your own unit cell (nodes and struts), for the cell type Custom</source>
      <translation>Die .json-Datei einer eigenen Einheitszelle (Knoten und Streben), für den Zelltyp Custom</translation>
    </message>
    <message>
      <source>The .toml or .json file of your own material</source>
      <translation>Die .toml- oder .json-Datei des eigenen Werkstoffs</translation>
    </message>
    <message>
      <source>The lattice infill to look at</source>
      <translation>Die Gitterfüllung, die betrachtet wird</translation>
    </message>
    <message>
      <source>The lattice infill whose designs these are</source>
      <translation>Die Gitterfüllung, deren Entwürfe es sind</translation>
    </message>
    <message>
      <source>The one density everywhere that takes the same filament, percent</source>
      <translation>Die eine Dichte überall, die gleich viel Filament braucht, Prozent</translation>
    </message>
    <message>
      <source>The radius varies along it</source>
      <translation>Entlang dieser Richtung ändert sich der Radius</translation>
    </message>
    <message>
      <source>The skin has the thickness that Loads and Sizing has found, and nowhere less than ShellThickness</source>
      <translation>Die Haut hat die Dicke, die Lasten und Auslegung gefunden hat, und nirgends weniger als ShellThickness</translation>
    </message>
    <message>
      <source>The solid that is printed</source>
      <translation>Der Körper, der gedruckt wird</translation>
    </message>
    <message>
      <source>The solid to fill: a solid, a Body, a Part, a link to one of these, or a closed mesh</source>
      <translation>Der zu füllende Volumenkörper: ein Volumenkörper, ein Body, ein Part, eine Verknüpfung darauf oder ein geschlossenes Netz</translation>
    </message>
    <message>
      <source>The status in your language; not saved</source>
      <translation>Der Status in Ihrer Sprache; nicht gespeichert</translation>
    </message>
    <message>
      <source>The surface of the cell Formula: zero on it, of x, y and z, which run from 0 to 2 pi over a cell</source>
      <translation>Die Fläche der Zelle Formula: null auf ihr, von x, y und z, die über eine Zelle von 0 bis 2 pi laufen</translation>
    </message>
    <message>
      <source>The unit cell: one of the library, a TPMS such as Gyroid, or the .json file of your own</source>
      <translation>Die Einheitszelle: eine der Bibliothek, eine TPMS wie Gyroid, oder die .json-Datei einer eigenen</translation>
    </message>
    <message>
      <source>Their volume</source>
      <translation>Ihr Volumen</translation>
    </message>
    <message>
      <source>Thickness of a sheet, measured across it</source>
      <translation>Dicke einer Wand, quer zu ihr gemessen</translation>
    </message>
    <message>
      <source>Thickness of the closed skin; 0 for none: the lattice is cut at the outer surface</source>
      <translation>Dicke der geschlossenen Haut; 0 für keine: das Gitter wird an der Außenfläche geschnitten</translation>
    </message>
    <message>
      <source>Thickness of the skin below each of the SkinFaces, in mm; 0 leaves the face open</source>
      <translation>Dicke der Haut unter jeder der SkinFaces, in mm; 0 lässt die Fläche offen</translation>
    </message>
    <message>
      <source>Thinnest Strut</source>
      <translation>Dünnste Strebe</translation>
    </message>
    <message>
      <source>Thinnest Wall</source>
      <translation>Dünnste Wand</translation>
    </message>
    <message>
      <source>Through-holes of the mesh</source>
      <translation>Durchgangslöcher des Netzes</translation>
    </message>
    <message>
      <source>Told Densities</source>
      <translation>Genannte Dichten</translation>
    </message>
    <message>
      <source>Top Layers</source>
      <translation>Deckschichten</translation>
    </message>
    <message>
      <source>Touching</source>
      <translation>Berührend</translation>
    </message>
    <message>
      <source>Triangles</source>
      <translation>Dreiecke</translation>
    </message>
    <message>
      <source>Triangles of the mesh</source>
      <translation>Dreiecke des Netzes</translation>
    </message>
    <message>
      <source>Trim</source>
      <translation>Beschnitt</translation>
    </message>
    <message>
      <source>Turn about the position of Orientation; otherwise about the middle of the solid's box</source>
      <translation>Um die Position von Orientation drehen; sonst um die Mitte des Quaders um den Volumenkörper</translation>
    </message>
    <message>
      <source>Turns the lattice, not the solid: about this axis, by this angle, counter-clockwise seen against it; cells then begin at a corner of the box that is turned with them</source>
      <translation>Dreht das Gitter, nicht den Volumenkörper: um diese Achse, um diesen Winkel, gegen den Uhrzeigersinn, ihr entgegen gesehen; Zellen beginnen dann an einer Ecke des Quaders, der mit ihnen gedreht ist</translation>
    </message>
    <message>
      <source>Two faces between which cells lie, or one upon which they do; each has four sides</source>
      <translation>Zwei Flächen, zwischen denen Zellen liegen, oder eine, auf der sie liegen; jede hat vier Seiten</translation>
    </message>
    <message>
      <source>Use Map Centre</source>
      <translation>Mittelpunkt verwenden</translation>
    </message>
    <message>
      <source>Use Origin</source>
      <translation>Ursprung verwenden</translation>
    </message>
    <message>
      <source>Use Rotation Origin</source>
      <translation>Drehpunkt verwenden</translation>
    </message>
    <message>
      <source>Values and their radii in mm, such as '0:0.5, 120:1.2', in place of the start and the end</source>
      <translation>Werte und ihre Radien in mm, etwa '0:0.5, 120:1.2', anstelle von Anfang und Ende</translation>
    </message>
    <message>
      <source>Vary</source>
      <translation>Variiert</translation>
    </message>
    <message>
      <source>Void Volume</source>
      <translation>Hohlraumvolumen</translation>
    </message>
    <message>
      <source>Voids</source>
      <translation>Hohlräume</translation>
    </message>
    <message>
      <source>Volume</source>
      <translation>Volumen</translation>
    </message>
    <message>
      <source>Volume of material</source>
      <translation>Volumen des Werkstoffs</translation>
    </message>
    <message>
      <source>Volume of the lattice over that of what it fills, between 0 and 1</source>
      <translation>Volumen des Gitters durch das dessen, was es füllt, zwischen 0 und 1</translation>
    </message>
    <message>
      <source>Volume of the lattice over what it fills</source>
      <translation>Volumen des Gitters im Verhältnis zum gefüllten Raum</translation>
    </message>
    <message>
      <source>Voronoi</source>
      <translation>Voronoi</translation>
    </message>
    <message>
      <source>Wall Formula</source>
      <translation>Formel der Wände</translation>
    </message>
    <message>
      <source>Wall Kind</source>
      <translation>Art der Wände</translation>
    </message>
    <message>
      <source>Wall Offset</source>
      <translation>Versatz der Wände</translation>
    </message>
    <message>
      <source>Wall Thickness</source>
      <translation>Wanddicke</translation>
    </message>
    <message>
      <source>Walls</source>
      <translation>Wände</translation>
    </message>
    <message>
      <source>Warnings</source>
      <translation>Warnungen</translation>
    </message>
    <message>
      <source>Watertight</source>
      <translation>Wasserdicht</translation>
    </message>
    <message>
      <source>What an update of these properties comes to</source>
      <translation>Was eine Aktualisierung mit diesen Eigenschaften ergibt</translation>
    </message>
    <message>
      <source>What does not suit the process</source>
      <translation>Was nicht zum Verfahren passt</translation>
    </message>
    <message>
      <source>What sets the struts' radius: itself, or a target of the lattice or the part, for which it is found</source>
      <translation>Was den Radius der Streben bestimmt: er selbst oder ein Ziel für Gitter oder Teil, für das er gefunden wird</translation>
    </message>
    <message>
      <source>What the density follows</source>
      <translation>Was die Dichte bestimmt</translation>
    </message>
    <message>
      <source>What the figures are of</source>
      <translation>Wovon die Zahlen sind</translation>
    </message>
    <message>
      <source>What the lattice consists of: cells, Voronoi or Delaunay edges of random points, nodes and struts of a file, or layers of cells that follow faces picked in FreeCAD</source>
      <translation>Woraus das Gitter besteht: Zellen, Voronoi- oder Delaunay-Kanten zufälliger Punkte, Knoten und Streben einer Datei oder Lagen von Zellen, die in FreeCAD gewählten Flächen folgen</translation>
    </message>
    <message>
      <source>What the lattice is coloured by</source>
      <translation>Wonach das Gitter eingefärbt ist</translation>
    </message>
    <message>
      <source>What the part is made of: its density gives the mass, its stiffness goes into solver decks</source>
      <translation>Woraus das Teil besteht: die Dichte ergibt die Masse, die Steifigkeit geht in die Dateien für Löser</translation>
    </message>
    <message>
      <source>What the slicer is told of each, so that it lays as much, percent</source>
      <translation>Was dem Slicer von jedem gesagt wird, damit er so viel legt, Prozent</translation>
    </message>
    <message>
      <source>What to know about this result</source>
      <translation>Was man über dieses Ergebnis wissen sollte</translation>
    </message>
    <message>
      <source>Where cells are stretched or bent, struts stay straight and round; otherwise they are deformed with their cells, as published</source>
      <translation>Wo Zellen gestreckt oder gebogen sind, bleiben Streben gerade und rund; sonst werden sie mit ihren Zellen verformt, wie veröffentlicht</translation>
    </message>
    <message>
      <source>Where holes go through the skin</source>
      <translation>Wo Löcher durch die Haut gehen</translation>
    </message>
    <message>
      <source>Where the records and the page of the study are</source>
      <translation>Wo die Aufzeichnungen und die Seite der Studie liegen</translation>
    </message>
    <message>
      <source>Where the scale of colours begins; as its end: from the values themselves</source>
      <translation>Wo die Farbskala beginnt; gleich ihrem Ende: nach den Werten selbst</translation>
    </message>
    <message>
      <source>Where the scale of colours ends</source>
      <translation>Wo die Farbskala endet</translation>
    </message>
    <message>
      <source>Whether the bands are those of these values</source>
      <translation>Ob die Bänder zu diesen Werten gehören</translation>
    </message>
    <message>
      <source>Whether the mesh fits the properties, or why not</source>
      <translation>Ob das Netz den Eigenschaften entspricht, oder warum nicht</translation>
    </message>
    <message>
      <source>Which cells hold a lattice: those that touch the inside, whose centre lies inside, or that lie wholly inside</source>
      <translation>Welche Zellen Gitter enthalten: die das Innere berühren, deren Mitte darin liegt oder die ganz darin liegen</translation>
    </message>
    <message>
      <source>Which values of the file or the FEM result; empty for the only ones, or for vonMises</source>
      <translation>Welche Werte der Datei oder des FEM-Ergebnisses; leer für die einzigen, oder für vonMises</translation>
    </message>
    <message>
      <source>Which values of the file or the FEM result; empty for the usual ones</source>
      <translation>Welche Werte der Datei oder des FEM-Ergebnisses; leer für die üblichen</translation>
    </message>
    <message>
      <source>Whole</source>
      <translation>Ganz</translation>
    </message>
    <message>
      <source>Why combinations were passed over, or failed</source>
      <translation>Warum Kombinationen übergangen wurden oder scheiterten</translation>
    </message>
    <message>
      <source>Young's modulus of the lattice along StiffnessDirection, of the chosen material</source>
      <translation>Elastizitätsmodul des Gitters entlang StiffnessDirection, aus dem gewählten Werkstoff</translation>
    </message>
    <message>
      <source>lambda as a formula of s</source>
      <translation>Lambda als Formel von s</translation>
    </message>
    <message>
      <source>lambda at the far end, s = 1</source>
      <translation>Lambda am fernen Ende, s = 1</translation>
    </message>
    <message>
      <source>lambda at the near end, s = 0</source>
      <translation>Lambda am nahen Ende, s = 0</translation>
    </message>
    <message>
      <source>part: skin and lattice; lattice: without the skin; domain: what the lattice fills</source>
      <translation>part: Haut und Gitter; lattice: ohne die Haut; domain: was das Gitter füllt</translation>
    </message>
    <message>
      <source>r: radius of the struts</source>
      <translation>r: Radius der Streben</translation>
    </message>
    <message>
      <source>sheet: a wall about the surface; skeleton: where its formula is negative; complement: where it is positive</source>
      <translation>sheet: eine Wand um die Fläche; skeleton: wo ihre Formel negativ ist; complement: wo sie positiv ist</translation>
    </message>
    <message>
      <source>trim: the lattice is cut at the wall; whole: cells stay whole, and a skin joins what reaches it</source>
      <translation>Beschnitt (trim): das Gitter wird an der Wand geschnitten; ganz (whole): Zellen bleiben ganz, und eine Haut verbindet, was sie erreicht</translation>
    </message>
    <message>
      <source>value:percent pairs in place of start and end, such as 0:10, 80:60</source>
      <translation>Paare Wert:Prozent statt Anfang und Ende, etwa 0:10, 80:60</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_CellLibrary</name>
    <message>
      <source>Browse the unit cells, load your own, make one of a sketch, and give it to a lattice infill</source>
      <translation>Einheitszellen ansehen, eigene laden, eine aus einer Skizze machen und einer Gitterfüllung geben</translation>
    </message>
    <message>
      <source>Cell Library</source>
      <translation>Zellbibliothek</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_CheckGroup</name>
    <message>
      <source>Check</source>
      <translation>Prüfen</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_CheckMesh</name>
    <message>
      <source>Check Mesh</source>
      <translation>Netz prüfen</translation>
    </message>
    <message>
      <source>Report on the selected mesh: closed, bodies, volume, angles, triangles that cross, and what a file keeps of it</source>
      <translation>Bericht über das gewählte Netz: geschlossen, Körper, Volumen, Winkel, sich kreuzende Dreiecke, und was eine Datei davon behält</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_ColourBy</name>
    <message>
      <source>Colour By</source>
      <translation>Einfärben nach</translation>
    </message>
    <message>
      <source>Colour the selected lattice infill by radius, cell size, overhang, stress or another quantity, with a legend, and read off values with the mouse</source>
      <translation>Die ausgewählte Gitterfüllung nach Radius, Zellgröße, Überhang, Spannung oder einer anderen Größe einfärben, mit Legende, und Werte mit der Maus ablesen</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_Coupons</name>
    <message>
      <source>Coupons</source>
      <translation>Proben</translation>
    </message>
    <message>
      <source>Make specimens of the selected infill's lattice to print, press, pull and measure, numbered in relief</source>
      <translation>Proben vom Gitter der ausgewählten Füllung machen, zum Drucken, Drücken, Ziehen und Messen, mit Nummern im Relief</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_DesignStudy</name>
    <message>
      <source>Apply Design</source>
      <translation>Entwurf anwenden</translation>
    </message>
    <message>
      <source>Design Study</source>
      <translation>Entwurfsstudie</translation>
    </message>
    <message>
      <source>Try many values of the selected lattice infill's properties, see mass against stiffness, and give it the best</source>
      <translation>Viele Werte der Eigenschaften der gewählten Gitterfüllung versuchen, Masse gegen Steifigkeit sehen und ihr die besten geben</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_Edit</name>
    <message>
      <source>Change the selected lattice infill in its panel, with a preview</source>
      <translation>Die gewählte Gitterfüllung in ihrem Aufgabenfenster ändern, mit Vorschau</translation>
    </message>
    <message>
      <source>Edit Lattice Infill</source>
      <translation>Gitterfüllung bearbeiten</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_ExampleBracket</name>
    <message>
      <source>Bracket</source>
      <translation>Lagerbock</translation>
    </message>
    <message>
      <source>Open a bracket on four bolts, filled with a lattice, in a new document</source>
      <translation>Öffnet in einem neuen Dokument einen Lagerbock auf vier Schrauben, mit Gitter gefüllt</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_ExamplePistonRod</name>
    <message>
      <source>Open a piston rod, filled with a lattice, in a new document</source>
      <translation>Öffnet in einem neuen Dokument ein Pleuel, mit Gitter gefüllt</translation>
    </message>
    <message>
      <source>Piston Rod</source>
      <translation>Pleuel</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_Export</name>
    <message>
      <source>Export Lattice</source>
      <translation>Gitter exportieren</translation>
    </message>
    <message>
      <source>Write the selected lattice infill for the printer (STL, 3MF with or without beams, PLY, OBJ, layers), for CAD (STEP) or for CalculiX</source>
      <translation>Schreibt die gewählte Gitterfüllung für den Drucker (STL, 3MF mit oder ohne Balken, PLY, OBJ, Schichten), für CAD (STEP) oder für CalculiX</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_ExportGroup</name>
    <message>
      <source>Export</source>
      <translation>Ausgeben</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_FemAnalysis</name>
    <message>
      <source>FEM Analysis</source>
      <translation>FEM-Analyse</translation>
    </message>
    <message>
      <source>Make an analysis of the selected lattice infill for the FEM workbench, of beams or of tetrahedra, ready for constraints</source>
      <translation>Erstellt für den FEM-Arbeitsbereich eine Analyse der gewählten Gitterfüllung, aus Balken oder Tetraedern, bereit für Randbedingungen</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_Help</name>
    <message>
      <source>Read about every command, and a tutorial of five minutes</source>
      <translation>Alles über jeden Befehl, und eine Einführung in fünf Minuten</translation>
    </message>
    <message>
      <source>VOLFREP Help</source>
      <translation>Hilfe zu VOLFREP</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_LatticeInfill</name>
    <message>
      <source>Lattice Infill</source>
      <translation>Gitterfüllung</translation>
    </message>
    <message>
      <source>Make the selected solid light: a closed skin and a strut lattice inside</source>
      <translation>Macht den gewählten Volumenkörper leicht: eine geschlossene Haut und innen ein Strebengitter</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_LoadsGroup</name>
    <message>
      <source>Loads</source>
      <translation>Lasten</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_LookGroup</name>
    <message>
      <source>Look</source>
      <translation>Ansehen</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_MakeGroup</name>
    <message>
      <source>Make</source>
      <translation>Herstellen</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_OpenFaces</name>
    <message>
      <source>Open Faces</source>
      <translation>Flächen öffnen</translation>
    </message>
    <message>
      <source>Select a lattice infill and faces of its solid: they get no skin</source>
      <translation>Eine Gitterfüllung und Flächen ihres Volumenkörpers wählen: sie bekommen keine Haut</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_Orient</name>
    <message>
      <source>Build Direction</source>
      <translation>Baurichtung</translation>
    </message>
    <message>
      <source>Find how the selected lattice infill, or solid, is built with the least overhang and support, and turn it so</source>
      <translation>Finden, wie die ausgewählte Gitterfüllung oder der Körper mit den wenigsten Überhängen und Stützen gebaut wird, und so drehen</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_PreviewOnly</name>
    <message>
      <source>Preview Only</source>
      <translation>Nur Vorschau</translation>
    </message>
    <message>
      <source>Show the struts of the selected lattice infill and their figures without making a mesh; once more takes them away</source>
      <translation>Zeigt die Streben der gewählten Gitterfüllung und ihre Zahlen, ohne ein Netz zu erzeugen; noch einmal nimmt sie weg</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_PrintCheck</name>
    <message>
      <source>Print Check</source>
      <translation>Druckprüfung</translation>
    </message>
    <message>
      <source>See what hangs over, is too thin or holds powder when the selected lattice infill is printed</source>
      <translation>Zeigt, was überhängt, zu dünn ist oder Pulver hält, wenn die gewählte Gitterfüllung gedruckt wird</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_SectionView</name>
    <message>
      <source>Cut the selected lattice open on the screen, along a plane that can be moved; the lattice itself stays whole</source>
      <translation>Schneidet das gewählte Gitter am Bildschirm auf, entlang einer verschiebbaren Ebene; das Gitter selbst bleibt ganz</translation>
    </message>
    <message>
      <source>Section View</source>
      <translation>Schnittansicht</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_SizeLattice</name>
    <message>
      <source>Loads and Sizing</source>
      <translation>Lasten und Auslegung</translation>
    </message>
    <message>
      <source>Pick what holds and loads the selected lattice infill, or solid, and find the radii of its struts: least mass within limits, or most stiffness at a mass</source>
      <translation>Wählen, was die gewählte Gitterfüllung oder den Körper hält und belastet, und die Radien der Streben finden: geringste Masse innerhalb von Grenzen oder größte Steifigkeit bei einer Masse</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_SlicerInfill</name>
    <message>
      <source>Let a slicer print the selected solid with an infill that is denser where a field says: bands of density that follow the solid, for PrusaSlicer, OrcaSlicer and Bambu Studio</source>
      <translation>Den ausgewählten Körper von einem Slicer mit einer Füllung drucken lassen, die dichter ist, wo ein Feld es sagt: Bänder der Dichte, die dem Körper folgen, für PrusaSlicer, OrcaSlicer und Bambu Studio</translation>
    </message>
    <message>
      <source>Slicer Infill</source>
      <translation>Slicer-Füllung</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_SolidBeside</name>
    <message>
      <source>Show the solid beside the selected lattice infill; once more takes it away</source>
      <translation>Den Volumenkörper neben der gewählten Gitterfüllung zeigen; noch einmal nimmt ihn weg</translation>
    </message>
    <message>
      <source>Solid Beside</source>
      <translation>Volumenkörper daneben</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_Statistics</name>
    <message>
      <source>Statistics</source>
      <translation>Statistik</translation>
    </message>
    <message>
      <source>Tables of the selected lattice infills, or of all in the document: cells, struts, density, mass, times, memory</source>
      <translation>Tabellen der gewählten Gitterfüllungen oder aller im Dokument: Zellen, Streben, Dichte, Masse, Zeiten, Speicher</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_StrutResults</name>
    <message>
      <source>Colour the struts of the selected lattice infill by radius, stress, buckling or displacement under the load cases of the FEM workbench</source>
      <translation>Die Streben der gewählten Gitterfüllung nach Radius, Spannung, Knicken oder Verschiebung unter den Lastfällen des FEM-Arbeitsbereichs einfärben</translation>
    </message>
    <message>
      <source>Strut Results</source>
      <translation>Strebenergebnisse</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_ToSolid</name>
    <message>
      <source>Lattice To Solid</source>
      <translation>Gitter in Volumenkörper</translation>
    </message>
    <message>
      <source>Make a Part solid of exact surfaces or of plane faces, links to its joints, or the struts' axes</source>
      <translation>Erzeugt einen Part-Volumenkörper aus exakten Flächen oder ebenen Facetten, Verknüpfungen auf seine Knoten oder die Achsen der Streben</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_Update</name>
    <message>
      <source>Compute the selected lattice infill now, also with AutoUpdate off</source>
      <translation>Berechnet die gewählte Gitterfüllung jetzt, auch wenn AutoUpdate aus ist</translation>
    </message>
    <message>
      <source>Update Lattice Infill</source>
      <translation>Gitterfüllung aktualisieren</translation>
    </message>
  </context>
  <context>
    <name>VolfrepCells</name>
    <message>
      <source>All cells</source>
      <translation>Alle Zellen</translation>
    </message>
    <message>
      <source>Also known as</source>
      <translation>Auch bekannt als</translation>
    </message>
    <message>
      <source>Apply</source>
      <translation>Anwenden</translation>
    </message>
    <message>
      <source>Apply to {label}</source>
      <translation>Auf {label} anwenden</translation>
    </message>
    <message>
      <source>Carries load by</source>
      <translation>Trägt Last durch</translation>
    </message>
    <message>
      <source>Cell size L</source>
      <translation>Zellgröße L</translation>
    </message>
    <message>
      <source>Close</source>
      <translation>Schließen</translation>
    </message>
    <message>
      <source>Compute</source>
      <translation>Berechnen</translation>
    </message>
    <message>
      <source>Drawn with L = {size:g} mm; every L can be given to an infill.</source>
      <translation>Gezeichnet mit L = {size:g} mm; eine Füllung kann jedes L bekommen.</translation>
    </message>
    <message>
      <source>File</source>
      <translation>Datei</translation>
    </message>
    <message>
      <source>Find cells by their stiffness and density, in a chart</source>
      <translation>Zellen nach ihrer Steifigkeit und Dichte in einem Diagramm suchen</translation>
    </message>
    <message>
      <source>Find...</source>
      <translation>Suchen...</translation>
    </message>
    <message>
      <source>From Selection</source>
      <translation>Aus Auswahl</translation>
    </message>
    <message>
      <source>Give the picked cell to the selected lattice infill</source>
      <translation>Gibt die gewählte Zelle der ausgewählten Gitterfüllung</translation>
    </message>
    <message>
      <source>Good for</source>
      <translation>Gut für</translation>
    </message>
    <message>
      <source>Homogenise this cell with this radius: it takes some seconds</source>
      <translation>Diese Zelle mit diesem Radius homogenisieren: es dauert einige Sekunden</translation>
    </message>
    <message>
      <source>Load Cell</source>
      <translation>Zelle laden</translation>
    </message>
    <message>
      <source>Load...</source>
      <translation>Laden...</translation>
    </message>
    <message>
      <source>Make a cell of the straight edges of the selected sketches, wires or shapes; the cube about them is the cell</source>
      <translation>Macht eine Zelle aus den geraden Kanten der gewählten Skizzen, Drähte oder Formen; der Würfel um sie ist die Zelle</translation>
    </message>
    <message>
      <source>Material</source>
      <translation>Werkstoff</translation>
    </message>
    <message>
      <source>Maxwell number</source>
      <translation>Maxwell-Zahl</translation>
    </message>
    <message>
      <source>Nodes</source>
      <translation>Knoten</translation>
    </message>
    <message>
      <source>Properties of {name}</source>
      <translation>Eigenschaften von {name}</translation>
    </message>
    <message>
      <source>Read a cell of your own from a JSON file</source>
      <translation>Liest eine eigene Zelle aus einer JSON-Datei</translation>
    </message>
    <message>
      <source>Save As...</source>
      <translation>Speichern unter...</translation>
    </message>
    <message>
      <source>Save Cell</source>
      <translation>Zelle speichern</translation>
    </message>
    <message>
      <source>Set Unit Cell</source>
      <translation>Einheitszelle setzen</translation>
    </message>
    <message>
      <source>Sheet thickness</source>
      <translation>Wanddicke</translation>
    </message>
    <message>
      <source>Strut radius r</source>
      <translation>Strebenradius r</translation>
    </message>
    <message>
      <source>Struts</source>
      <translation>Streben</translation>
    </message>
    <message>
      <source>The properties of this TPMS take some seconds: press Compute.</source>
      <translation>Die Eigenschaften dieser TPMS brauchen einige Sekunden: Berechnen drücken.</translation>
    </message>
    <message>
      <source>This cell with this radius is not in the catalogue: press Compute.</source>
      <translation>Diese Zelle mit diesem Radius steht nicht im Katalog: Berechnen drücken.</translation>
    </message>
    <message>
      <source>Unit cell (*.json)</source>
      <translation>Einheitszelle (*.json)</translation>
    </message>
    <message>
      <source>Write the picked cell to a JSON file</source>
      <translation>Schreibt die gewählte Zelle in eine JSON-Datei</translation>
    </message>
    <message>
      <source>auxetic: wider when pulled</source>
      <translation>auxetisch: wird beim Ziehen breiter</translation>
    </message>
    <message>
      <source>bending</source>
      <translation>Biegung</translation>
    </message>
    <message>
      <source>not saved</source>
      <translation>nicht gespeichert</translation>
    </message>
    <message>
      <source>open: flow, bone, foams</source>
      <translation>offen: Strömung, Knochen, Schäume</translation>
    </message>
    <message>
      <source>soft: energy, vibration</source>
      <translation>weich: Energie, Schwingungen</translation>
    </message>
    <message>
      <source>stiff along its columns</source>
      <translation>steif längs ihrer Säulen</translation>
    </message>
    <message>
      <source>stiff in every direction</source>
      <translation>steif in jeder Richtung</translation>
    </message>
    <message>
      <source>stretching</source>
      <translation>Zug und Druck</translation>
    </message>
    <message>
      <source>walls along a surface</source>
      <translation>Wände entlang einer Fläche</translation>
    </message>
  </context>
  <context>
    <name>VolfrepColours</name>
    <message>
      <source>Automatic</source>
      <translation>Automatisch</translation>
    </message>
    <message>
      <source>Buckling</source>
      <translation>Knicken</translation>
    </message>
    <message>
      <source>Cell size</source>
      <translation>Zellgröße</translation>
    </message>
    <message>
      <source>Cell size, mm</source>
      <translation>Zellgröße, mm</translation>
    </message>
    <message>
      <source>Colour by</source>
      <translation>Einfärben nach</translation>
    </message>
    <message>
      <source>Colours of {label}</source>
      <translation>Farben von {label}</translation>
    </message>
    <message>
      <source>Deformed</source>
      <translation>Verformt</translation>
    </message>
    <message>
      <source>Displacement</source>
      <translation>Verschiebung</translation>
    </message>
    <message>
      <source>Displacement, mm</source>
      <translation>Verschiebung, mm</translation>
    </message>
    <message>
      <source>Displacements enlarged; 0: automatic</source>
      <translation>Vergrößerung der Verschiebungen; 0: automatisch</translation>
    </message>
    <message>
      <source>Field</source>
      <translation>Feld</translation>
    </message>
    <message>
      <source>Field of the radius</source>
      <translation>Feld des Radius</translation>
    </message>
    <message>
      <source>From the smallest to the largest of the values</source>
      <translation>Vom kleinsten bis zum größten der Werte</translation>
    </message>
    <message>
      <source>Governing limit</source>
      <translation>Maßgebende Grenze</translation>
    </message>
    <message>
      <source>Governing limit of the skin</source>
      <translation>Maßgebende Grenze der Haut</translation>
    </message>
    <message>
      <source>Load case</source>
      <translation>Lastfall</translation>
    </message>
    <message>
      <source>Move the mouse over the lattice to read values</source>
      <translation>Die Maus über das Gitter bewegen, um Werte abzulesen</translation>
    </message>
    <message>
      <source>No stresses are kept in the document: Loads and Sizing puts them there.</source>
      <translation>Im Dokument sind keine Spannungen: Lasten und Auslegung legt sie dort ab.</translation>
    </message>
    <message>
      <source>None</source>
      <translation>Ohne</translation>
    </message>
    <message>
      <source>Of struts as printed ({table}).</source>
      <translation>Von Streben wie gedruckt ({table}).</translation>
    </message>
    <message>
      <source>Overhang</source>
      <translation>Überhang</translation>
    </message>
    <message>
      <source>Overhang, degrees</source>
      <translation>Überhang, Grad</translation>
    </message>
    <message>
      <source>Picture</source>
      <translation>Bild</translation>
    </message>
    <message>
      <source>Radius</source>
      <translation>Radius</translation>
    </message>
    <message>
      <source>Radius, mm</source>
      <translation>Radius, mm</translation>
    </message>
    <message>
      <source>Save the view with its legend, on white, for a report</source>
      <translation>Die Ansicht mit ihrer Legende auf Weiß speichern, für einen Bericht</translation>
    </message>
    <message>
      <source>Share of the buckling load</source>
      <translation>Anteil der Knicklast</translation>
    </message>
    <message>
      <source>Skin</source>
      <translation>Haut</translation>
    </message>
    <message>
      <source>Skin thickness, mm</source>
      <translation>Hautdicke, mm</translation>
    </message>
    <message>
      <source>Stress</source>
      <translation>Spannung</translation>
    </message>
    <message>
      <source>Stress (von Mises), MPa</source>
      <translation>Spannung (von Mises), MPa</translation>
    </message>
    <message>
      <source>Strut radius, mm</source>
      <translation>Strebenradius, mm</translation>
    </message>
    <message>
      <source>Temperature</source>
      <translation>Temperatur</translation>
    </message>
    <message>
      <source>Temperature, °C</source>
      <translation>Temperatur, °C</translation>
    </message>
    <message>
      <source>The lattice is not the one that was sized any more: size it again.</source>
      <translation>Das Gitter ist nicht mehr das, das dimensioniert wurde: dimensionieren Sie es noch einmal.</translation>
    </message>
    <message>
      <source>The skin was not sized: Loads and Sizing does that with a thinnest skin.</source>
      <translation>Die Haut wurde nicht ausgelegt: Lasten und Auslegung tut das mit einer dünnsten Haut.</translation>
    </message>
    <message>
      <source>What governs is not kept in the document: Loads and Sizing puts it there.</source>
      <translation>Im Dokument steht nicht, was maßgebend ist: Lasten und Auslegung legt es dort ab.</translation>
    </message>
    <message>
      <source>automatic: {factor:g} ×</source>
      <translation>automatisch: {factor:g} ×</translation>
    </message>
    <message>
      <source>from</source>
      <translation>von</translation>
    </message>
    <message>
      <source>to</source>
      <translation>bis</translation>
    </message>
    <message>
      <source>{value} under the mouse</source>
      <translation>{value} unter der Maus</translation>
    </message>
  </context>
  <context>
    <name>VolfrepCommands</name>
    <message>
      <source>'{label}' is a closed surface and not a solid yet: convert it (Part &gt; Convert to solid).</source>
      <translation>'{label}' ist eine geschlossene Fläche und noch kein Körper: umwandeln (Part &gt; In Festkörper umwandeln).</translation>
    </message>
    <message>
      <source>'{label}' is an open surface, which encloses nothing: close it or give it a thickness, and convert it to a solid (Part &gt; Convert to solid).</source>
      <translation>'{label}' ist eine offene Fläche, die nichts umschließt: schließen oder ihr eine Dicke geben, und in einen Körper umwandeln (Part &gt; In Festkörper umwandeln).</translation>
    </message>
    <message>
      <source>A panel is open: end it first.</source>
      <translation>Ein Aufgabenfenster ist offen: erst dieses beenden.</translation>
    </message>
    <message>
      <source>Analyse '{label}' with:</source>
      <translation>'{label}' analysieren mit:</translation>
    </message>
    <message>
      <source>Check Mesh: {label}</source>
      <translation>Netz prüfen: {label}</translation>
    </message>
    <message>
      <source>Edge of a pixel</source>
      <translation>Kante eines Bildpunkts</translation>
    </message>
    <message>
      <source>Export Layers</source>
      <translation>Schichten exportieren</translation>
    </message>
    <message>
      <source>Fill {count} solids, each with cells that suit its size? A single one opens the panel.</source>
      <translation>{count} Körper füllen, jeden mit Zellen, die zu seiner Größe passen? Ein einzelner öffnet das Panel.</translation>
    </message>
    <message>
      <source>Height of a layer</source>
      <translation>Höhe einer Schicht</translation>
    </message>
    <message>
      <source>Make of '{label}':</source>
      <translation>Aus '{label}' machen:</translation>
    </message>
    <message>
      <source>Mesh of {label}</source>
      <translation>Netz von {label}</translation>
    </message>
    <message>
      <source>Select one lattice infill and, with Ctrl, faces of its solid.</source>
      <translation>Eine Gitterfüllung und, mit Strg, Flächen ihres Körpers auswählen.</translation>
    </message>
    <message>
      <source>Select one lattice infill or one design study.</source>
      <translation>Eine Gitterfüllung oder eine Variantenstudie auswählen.</translation>
    </message>
    <message>
      <source>Select one lattice infill that has a solid, or one solid, with its 3D view in front.</source>
      <translation>Eine Gitterfüllung mit Körper oder einen Körper auswählen, dessen 3D-Ansicht vorn ist.</translation>
    </message>
    <message>
      <source>Select one lattice infill that has a solid, with its 3D view in front.</source>
      <translation>Eine Gitterfüllung mit Körper auswählen, deren 3D-Ansicht vorn ist.</translation>
    </message>
    <message>
      <source>Select one lattice infill that is computed, or one mesh.</source>
      <translation>Eine berechnete Gitterfüllung oder ein Netz auswählen.</translation>
    </message>
    <message>
      <source>Select one lattice infill that is computed, with its 3D view in front.</source>
      <translation>Eine berechnete Gitterfüllung auswählen, deren 3D-Ansicht vorn ist.</translation>
    </message>
    <message>
      <source>Select one lattice infill.</source>
      <translation>Eine Gitterfüllung auswählen.</translation>
    </message>
    <message>
      <source>Select one or more solids: a Body, a Part, a link to one, a closed mesh.</source>
      <translation>Einen oder mehrere Körper auswählen: Körper, Part, Verknüpfung dazu oder geschlossenes Netz.</translation>
    </message>
    <message>
      <source>Select one solid, with Ctrl a FEM result or sized lattice infill, or one slicer infill.</source>
      <translation>Einen Körper auswählen, mit Strg ein FEM-Ergebnis oder eine bemessene Gitterfüllung dazu, oder eine Slicer-Füllung.</translation>
    </message>
    <message>
      <source>There is no lattice infill in this document: make one first.</source>
      <translation>In diesem Dokument ist keine Gitterfüllung: erst eine erzeugen.</translation>
    </message>
    <message>
      <source>beams</source>
      <translation>Balken</translation>
    </message>
    <message>
      <source>tetrahedra</source>
      <translation>Tetraeder</translation>
    </message>
    <message>
      <source>{file}: {estimate}. Write it?</source>
      <translation>{file}: {estimate}. Schreiben?</translation>
    </message>
    <message>
      <source>{label} is up to date</source>
      <translation>{label} ist aktuell</translation>
    </message>
    <message>
      <source>{label}: preview off</source>
      <translation>{label}: Vorschau aus</translation>
    </message>
    <message>
      <source>{label}: preview shown, figures in the report view</source>
      <translation>{label}: Vorschau gezeigt, Zahlen in der Berichtsansicht</translation>
    </message>
  </context>
  <context>
    <name>VolfrepCoupons</name>
    <message>
      <source>Bar with grips, for tension</source>
      <translation>Stab mit Einspannungen, für Zug</translation>
    </message>
    <message>
      <source>Beam, for bending on three points</source>
      <translation>Balken, für Dreipunktbiegung</translation>
    </message>
    <message>
      <source>Cells along the cube</source>
      <translation>Zellen entlang des Würfels</translation>
    </message>
    <message>
      <source>Cube between plates, for compression</source>
      <translation>Würfel zwischen Platten, für Druck</translation>
    </message>
    <message>
      <source>Folder for STL files</source>
      <translation>Ordner für STL-Dateien</translation>
    </message>
    <message>
      <source>Ladder of struts, whose diameters are measured</source>
      <translation>Leiter aus Streben, deren Durchmesser gemessen werden</translation>
    </message>
    <message>
      <source>Number of the first</source>
      <translation>Nummer der ersten</translation>
    </message>
    <message>
      <source>none: into the document only</source>
      <translation>keiner: nur ins Dokument</translation>
    </message>
  </context>
  <context>
    <name>VolfrepCurve</name>
    <message>
      <source>Curve: {name}</source>
      <translation>Kurve: {name}</translation>
    </message>
    <message>
      <source>Drag a point; double click for a new one, right click to remove one. Keys: Page Up and Down choose a point, arrows move it, Insert and Delete add and remove.</source>
      <translation>Einen Punkt ziehen; Doppelklick fügt einen hinzu, Rechtsklick entfernt einen. Tasten: Bild auf und ab wählen einen Punkt, Pfeile bewegen ihn, Einfg und Entf fügen hinzu und entfernen.</translation>
    </message>
    <message>
      <source>Falling</source>
      <translation>Fallend</translation>
    </message>
    <message>
      <source>Rising</source>
      <translation>Steigend</translation>
    </message>
    <message>
      <source>Shape of the curve</source>
      <translation>Form der Kurve</translation>
    </message>
    <message>
      <source>Shape...</source>
      <translation>Form ...</translation>
    </message>
    <message>
      <source>Step</source>
      <translation>Stufe</translation>
    </message>
    <message>
      <source>Thick at the ends</source>
      <translation>Dick an den Enden</translation>
    </message>
    <message>
      <source>Thick in the middle</source>
      <translation>Dick in der Mitte</translation>
    </message>
  </context>
  <context>
    <name>VolfrepFigures</name>
    <message>
      <source>Choose a process to see its limits.</source>
      <translation>Ein Verfahren wählen, um seine Grenzen zu sehen.</translation>
    </message>
    <message>
      <source>Told by Print Check, once computed.</source>
      <translation>Sagt die Druckprüfung nach dem Berechnen.</translation>
    </message>
    <message>
      <source>a closed skin</source>
      <translation>geschlossene Haut</translation>
    </message>
    <message>
      <source>at least {limit}</source>
      <translation>mindestens {limit}</translation>
    </message>
    <message>
      <source>at most {limit}</source>
      <translation>höchstens {limit}</translation>
    </message>
    <message>
      <source>closed voids</source>
      <translation>geschlossene Hohlräume</translation>
    </message>
    <message>
      <source>cost of the material</source>
      <translation>Kosten des Materials</translation>
    </message>
    <message>
      <source>longest flat strut</source>
      <translation>längste flache Strebe</translation>
    </message>
    <message>
      <source>narrowest gap</source>
      <translation>engster Spalt</translation>
    </message>
    <message>
      <source>none</source>
      <translation>keine</translation>
    </message>
    <message>
      <source>offset {radius} mm</source>
      <translation>Versatz {radius} mm</translation>
    </message>
    <message>
      <source>over {width} mm</source>
      <translation>über {width} mm</translation>
    </message>
    <message>
      <source>saved against the solid</source>
      <translation>gegen massiv gespart</translation>
    </message>
    <message>
      <source>strut radius {radius} mm</source>
      <translation>Strebenradius {radius} mm</translation>
    </message>
    <message>
      <source>struts below {angle}°</source>
      <translation>Streben unter {angle}°</translation>
    </message>
    <message>
      <source>thickness {radius} mm</source>
      <translation>Dicke {radius} mm</translation>
    </message>
    <message>
      <source>thinnest strut</source>
      <translation>dünnste Strebe</translation>
    </message>
    <message>
      <source>varies: see Print Check</source>
      <translation>verschieden: siehe Druckprüfung</translation>
    </message>
    <message>
      <source>{mass} g, {triangles} triangles, made in {seconds} s</source>
      <translation>{mass} g, {triangles} Dreiecke, in {seconds} s gemacht</translation>
    </message>
    <message>
      <source>{number} active cells</source>
      <translation>{number} aktive Zellen</translation>
    </message>
    <message>
      <source>{number} struts</source>
      <translation>{number} Streben</translation>
    </message>
    <message>
      <source>{voids}, holding {volume} cm³</source>
      <translation>{voids} mit {volume} cm³</translation>
    </message>
    <message>
      <source>{what}
relative density {density} %, mass {mass} g
about {triangles} triangles, {size} MB as STL, {seconds} s to compute</source>
      <translation>{what}
relative Dichte {density} %, Masse {mass} g
etwa {triangles} Dreiecke, {size} MB als STL, {seconds} s Rechenzeit</translation>
    </message>
  </context>
  <context>
    <name>VolfrepFinder</name>
    <message>
      <source>Density</source>
      <translation>Dichte</translation>
    </message>
    <message>
      <source>Find Cells</source>
      <translation>Zellen suchen</translation>
    </message>
    <message>
      <source>Modulus</source>
      <translation>Modul</translation>
    </message>
    <message>
      <source>No cell of the library has that: ask for something else.</source>
      <translation>Das hat keine Zelle der Bibliothek: nach etwas anderem fragen.</translation>
    </message>
    <message>
      <source>along</source>
      <translation>entlang</translation>
    </message>
    <message>
      <source>any: moduli over the solid's</source>
      <translation>beliebig: Moduln über dem des Körpers</translation>
    </message>
    <message>
      <source>cell</source>
      <translation>Zelle</translation>
    </message>
    <message>
      <source>density, %</source>
      <translation>Dichte, %</translation>
    </message>
    <message>
      <source>least strength</source>
      <translation>kleinste Festigkeit</translation>
    </message>
    <message>
      <source>least strength, MPa</source>
      <translation>kleinste Festigkeit, MPa</translation>
    </message>
    <message>
      <source>modulus</source>
      <translation>Modul</translation>
    </message>
    <message>
      <source>modulus over the solid's</source>
      <translation>Modul über dem des Körpers</translation>
    </message>
    <message>
      <source>modulus, MPa</source>
      <translation>Modul, MPa</translation>
    </message>
    <message>
      <source>of</source>
      <translation>aus</translation>
    </message>
    <message>
      <source>r, mm</source>
      <translation>r, mm</translation>
    </message>
    <message>
      <source>relative density</source>
      <translation>relative Dichte</translation>
    </message>
    <message>
      <source>{count} cells, with L = {size} mm</source>
      <translation>{count} Zellen, mit L = {size} mm</translation>
    </message>
  </context>
  <context>
    <name>VolfrepFormats</name>
    <message>
      <source>3MF</source>
      <translation>3MF</translation>
    </message>
    <message>
      <source>3MF, beams only</source>
      <translation>3MF, nur Balken</translation>
    </message>
    <message>
      <source>3MF, mesh and beams</source>
      <translation>3MF, Netz und Balken</translation>
    </message>
    <message>
      <source>3MF, project for OrcaSlicer and Bambu Studio</source>
      <translation>3MF, Projekt für OrcaSlicer und Bambu Studio</translation>
    </message>
    <message>
      <source>3MF, project for PrusaSlicer</source>
      <translation>3MF, Projekt für PrusaSlicer</translation>
    </message>
    <message>
      <source>3MF, within limits or compensated</source>
      <translation>3MF, in Grenzen oder kompensiert</translation>
    </message>
    <message>
      <source>CalculiX, beams</source>
      <translation>CalculiX, Balken</translation>
    </message>
    <message>
      <source>CalculiX, tetrahedra</source>
      <translation>CalculiX, Tetraeder</translation>
    </message>
    <message>
      <source>GLB, for viewers</source>
      <translation>GLB, für Betrachter</translation>
    </message>
    <message>
      <source>Layers, common layer interface</source>
      <translation>Schichten, Common Layer Interface</translation>
    </message>
    <message>
      <source>Layers, drawings</source>
      <translation>Schichten, Zeichnungen</translation>
    </message>
    <message>
      <source>Layers, pictures for resin printers</source>
      <translation>Schichten, Bilder für Harzdrucker</translation>
    </message>
    <message>
      <source>OBJ</source>
      <translation>OBJ</translation>
    </message>
    <message>
      <source>OFF</source>
      <translation>OFF</translation>
    </message>
    <message>
      <source>PLY</source>
      <translation>PLY</translation>
    </message>
    <message>
      <source>STEP, axes of the struts</source>
      <translation>STEP, Achsen der Streben</translation>
    </message>
    <message>
      <source>STEP, exact surfaces</source>
      <translation>STEP, exakte Flächen</translation>
    </message>
    <message>
      <source>STEP, instances of joints</source>
      <translation>STEP, Instanzen der Knoten</translation>
    </message>
    <message>
      <source>STEP, plane faces</source>
      <translation>STEP, ebene Facetten</translation>
    </message>
    <message>
      <source>STL</source>
      <translation>STL</translation>
    </message>
    <message>
      <source>STL, within limits or compensated</source>
      <translation>STL, in Grenzen oder kompensiert</translation>
    </message>
  </context>
  <context>
    <name>VolfrepFreshness</name>
    <message>
      <source>Comes once the mesh is there</source>
      <translation>Kommt, sobald das Netz da ist</translation>
    </message>
    <message>
      <source>Recompute first</source>
      <translation>Zuerst neu berechnen</translation>
    </message>
    <message>
      <source>The mesh of {labels} is out of date: {why}.</source>
      <translation>Das Netz von {labels} ist veraltet: {why}.</translation>
    </message>
    <message>
      <source>Update</source>
      <translation>Aktualisieren</translation>
    </message>
    <message>
      <source>Use it as it is</source>
      <translation>So verwenden, wie es ist</translation>
    </message>
    <message>
      <source>its present values cannot be computed</source>
      <translation>seine jetzigen Werte lassen sich nicht berechnen</translation>
    </message>
    <message>
      <source>values or the solid have changed since it was made</source>
      <translation>Werte oder der Körper haben sich geändert, seit es gemacht wurde</translation>
    </message>
    <message>
      <source>what it is made of has changed and is not recomputed yet</source>
      <translation>woraus es gemacht ist, hat sich geändert und ist noch nicht neu berechnet</translation>
    </message>
    <message>
      <source>{count} lattices are out of date</source>
      <translation>{count} Gitter sind nicht aktuell</translation>
    </message>
    <message>
      <source>{label} is out of date</source>
      <translation>{label} ist nicht aktuell</translation>
    </message>
  </context>
  <context>
    <name>VolfrepHelp</name>
    <message>
      <source>Back</source>
      <translation>Zurück</translation>
    </message>
    <message>
      <source>Contents</source>
      <translation>Inhalt</translation>
    </message>
  </context>
  <context>
    <name>VolfrepInstall</name>
    <message>
      <source>&amp;Copy Command</source>
      <translation>Befehl &amp;kopieren</translation>
    </message>
    <message>
      <source>&amp;Install</source>
      <translation>&amp;Installieren</translation>
    </message>
    <message>
      <source>All packages are there: go on.</source>
      <translation>Alle Pakete sind da: es kann weitergehen.</translation>
    </message>
    <message>
      <source>All packages are there: restart FreeCAD.</source>
      <translation>Alle Pakete sind da: FreeCAD neu starten.</translation>
    </message>
    <message>
      <source>C&amp;lose</source>
      <translation>&amp;Schließen</translation>
    </message>
    <message>
      <source>Installing...</source>
      <translation>Wird installiert ...</translation>
    </message>
    <message>
      <source>Packages for VOLFREP</source>
      <translation>Pakete für VOLFREP</translation>
    </message>
    <message>
      <source>The command is on the clipboard: run it, then restart FreeCAD.</source>
      <translation>Der Befehl ist in der Zwischenablage: ausführen, dann FreeCAD neu starten.</translation>
    </message>
    <message>
      <source>VOLFREP needs the Python packages {names}. Install puts them into FreeCAD's own folder {folder}, and nowhere else; it takes a connection to the internet and about a minute.</source>
      <translation>VOLFREP braucht die Python-Pakete {names}. Installieren legt sie in FreeCADs eigenen Ordner {folder} und nirgendwo sonst; das braucht eine Verbindung ins Internet und etwa eine Minute.</translation>
    </message>
    <message>
      <source>What the installation says</source>
      <translation>Was die Installation sagt</translation>
    </message>
    <message>
      <source>{names} could not be installed: read below why. The command can be copied and run elsewhere.</source>
      <translation>{names} ließ sich nicht installieren: unten steht, warum. Der Befehl kann kopiert und anderswo ausgeführt werden.</translation>
    </message>
    <message>
      <source>{names} is not on FreeCAD's list of allowed packages, so Install leaves it out; the command below has it. Some parts cannot be made without it.</source>
      <translation>{names} steht nicht auf FreeCADs Liste erlaubter Pakete, daher lässt Installieren es aus; der Befehl unten enthält es. Manche Teile lassen sich ohne es nicht herstellen.</translation>
    </message>
  </context>
  <context>
    <name>VolfrepJobs</name>
    <message>
      <source>Beams of {label}</source>
      <translation>Balken von {label}</translation>
    </message>
    <message>
      <source>Build direction of {label}</source>
      <translation>Baurichtung von {label}</translation>
    </message>
    <message>
      <source>Checking {label}</source>
      <translation>{label} wird geprüft</translation>
    </message>
    <message>
      <source>Colours of {label}</source>
      <translation>Farben von {label}</translation>
    </message>
    <message>
      <source>Coupons of {label}</source>
      <translation>Proben von {label}</translation>
    </message>
    <message>
      <source>Exact surfaces of {label}</source>
      <translation>Exakte Flächen von {label}</translation>
    </message>
    <message>
      <source>FEM analysis of {label}</source>
      <translation>FEM-Analyse von {label}</translation>
    </message>
    <message>
      <source>File of {label}</source>
      <translation>Datei von {label}</translation>
    </message>
    <message>
      <source>Filling {label}</source>
      <translation>{label} wird gefüllt</translation>
    </message>
    <message>
      <source>Heat in {label}</source>
      <translation>Wärme in {label}</translation>
    </message>
    <message>
      <source>Infill bands of {label}</source>
      <translation>Füllungsbänder von {label}</translation>
    </message>
    <message>
      <source>Instances of {label}</source>
      <translation>Instanzen von {label}</translation>
    </message>
    <message>
      <source>Layers of {label}</source>
      <translation>Schichten von {label}</translation>
    </message>
    <message>
      <source>Plane faces of {label}</source>
      <translation>Ebene Flächen von {label}</translation>
    </message>
    <message>
      <source>Print check of {label}</source>
      <translation>Druckprüfung von {label}</translation>
    </message>
    <message>
      <source>Properties of the lattice of {label}</source>
      <translation>Eigenschaften des Gitters von {label}</translation>
    </message>
    <message>
      <source>Sizing {label}</source>
      <translation>{label} dimensionieren</translation>
    </message>
    <message>
      <source>Struts of {label}</source>
      <translation>Streben von {label}</translation>
    </message>
    <message>
      <source>Studying {label}</source>
      <translation>{label} wird untersucht</translation>
    </message>
    <message>
      <source>Tetrahedra of {label}</source>
      <translation>Tetraeder von {label}</translation>
    </message>
    <message>
      <source>Writing {label}</source>
      <translation>{label} wird geschrieben</translation>
    </message>
  </context>
  <context>
    <name>VolfrepLabels</name>
    <message>
      <source>{label} analysis</source>
      <translation>{label} Analyse</translation>
    </message>
    <message>
      <source>{label} axes</source>
      <translation>{label} Achsen</translation>
    </message>
    <message>
      <source>{label} coupons</source>
      <translation>{label} Proben</translation>
    </message>
    <message>
      <source>{label} infill</source>
      <translation>{label} Füllung</translation>
    </message>
    <message>
      <source>{label} instances</source>
      <translation>{label} Verknüpfungen</translation>
    </message>
    <message>
      <source>{label} lattice</source>
      <translation>{label} Gitter</translation>
    </message>
    <message>
      <source>{label} print check</source>
      <translation>{label} Druckprüfung</translation>
    </message>
    <message>
      <source>{label} solid</source>
      <translation>{label} Volumenkörper</translation>
    </message>
    <message>
      <source>{label} study</source>
      <translation>{label} Studie</translation>
    </message>
  </context>
  <context>
    <name>VolfrepLoads</name>
    <message>
      <source>Another case, held as this one is</source>
      <translation>Ein weiterer Lastfall, gehalten wie dieser</translation>
    </message>
    <message>
      <source>Click at faces in the view that carry the force; Ctrl takes all alike</source>
      <translation>Flächen in der Ansicht anklicken, die die Kraft tragen; Strg nimmt alle gleichen</translation>
    </message>
    <message>
      <source>Click at faces in the view that do not move; Ctrl takes all alike</source>
      <translation>Flächen in der Ansicht anklicken, die sich nicht bewegen; Strg nimmt alle gleichen</translation>
    </message>
    <message>
      <source>Click at faces in the view that have this temperature; Ctrl takes all alike</source>
      <translation>Flächen in der Ansicht anklicken, die diese Temperatur haben; Strg nimmt alle gleichen</translation>
    </message>
    <message>
      <source>Click at faces in the view through which this heat flows in; below 0, out</source>
      <translation>Flächen in der Ansicht anklicken, durch die diese Wärme hineinfließt; unter 0 hinaus</translation>
    </message>
    <message>
      <source>Click at faces in the view under pressure; Ctrl takes all alike</source>
      <translation>Flächen in der Ansicht anklicken, auf die Druck wirkt; Strg nimmt alle gleichen</translation>
    </message>
    <message>
      <source>Direction</source>
      <translation>Richtung</translation>
    </message>
    <message>
      <source>Force</source>
      <translation>Kraft</translation>
    </message>
    <message>
      <source>Heat flow</source>
      <translation>Wärmestrom</translation>
    </message>
    <message>
      <source>Held</source>
      <translation>Gehalten</translation>
    </message>
    <message>
      <source>Load case {number}</source>
      <translation>Lastfall {number}</translation>
    </message>
    <message>
      <source>New case</source>
      <translation>Neuer Lastfall</translation>
    </message>
    <message>
      <source>Pressure</source>
      <translation>Druck</translation>
    </message>
    <message>
      <source>Remove</source>
      <translation>Entfernen</translation>
    </message>
    <message>
      <source>Size</source>
      <translation>Größe</translation>
    </message>
    <message>
      <source>Temperature</source>
      <translation>Temperatur</translation>
    </message>
    <message>
      <source>The part's own weight, downwards</source>
      <translation>Das eigene Gewicht des Teils, nach unten</translation>
    </message>
    <message>
      <source>Weight</source>
      <translation>Gewicht</translation>
    </message>
    <message>
      <source>into the face</source>
      <translation>in die Fläche</translation>
    </message>
    <message>
      <source>out of the face</source>
      <translation>aus der Fläche</translation>
    </message>
  </context>
  <context>
    <name>VolfrepMessages</name>
    <message>
      <source>Cancelled.</source>
      <translation>Abgebrochen.</translation>
    </message>
    <message>
      <source>{path} written</source>
      <translation>{path} geschrieben</translation>
    </message>
  </context>
  <context>
    <name>VolfrepNumbers</name>
    <message>
      <source>,</source>
      <translation>.</translation>
    </message>
    <message>
      <source>.</source>
      <translation>,</translation>
    </message>
  </context>
  <context>
    <name>VolfrepOrient</name>
    <message>
      <source>Least cost first: overhang, supports, height, footprint off the plate</source>
      <translation>Geringste Kosten zuerst: Überhang, Stützen, Höhe, Grundfläche neben der Platte</translation>
    </message>
    <message>
      <source>Needs support below</source>
      <translation>Braucht Stützen unter</translation>
    </message>
    <message>
      <source>Set Build Direction</source>
      <translation>Baurichtung setzen</translation>
    </message>
    <message>
      <source>The part stays; its print checks look along this direction</source>
      <translation>Das Teil bleibt; seine Druckprüfungen sehen entlang dieser Richtung</translation>
    </message>
    <message>
      <source>Turn Part</source>
      <translation>Teil drehen</translation>
    </message>
    <message>
      <source>Turned: z is up, and it stands on z = 0.</source>
      <translation>Gedreht: z ist oben, und es steht auf z = 0.</translation>
    </message>
    <message>
      <source>cost</source>
      <translation>Kosten</translation>
    </message>
    <message>
      <source>height</source>
      <translation>Höhe</translation>
    </message>
    <message>
      <source>now</source>
      <translation>jetzt</translation>
    </message>
    <message>
      <source>overhang</source>
      <translation>Überhang</translation>
    </message>
    <message>
      <source>up: {up}
{inside} mm² of the overhang in closed rooms; supports at most {support} mm³; stands on {base} mm², footprint {footprint} mm²</source>
      <translation>oben: {up}
{inside} mm² des Überhangs in geschlossenen Räumen; Stützen höchstens {support} mm³; steht auf {base} mm², Grundfläche {footprint} mm²</translation>
    </message>
    <message>
      <source>{checks}: built along it.</source>
      <translation>{checks}: entlang ihr gebaut.</translation>
    </message>
  </context>
  <context>
    <name>VolfrepPreferences</name>
    <message>
      <source>A change that comes to more triangles waits for Update Lattice Infill</source>
      <translation>Eine Änderung, die mehr Dreiecke ergibt, wartet auf Gitterfüllung aktualisieren</translation>
    </message>
    <message>
      <source>A mesh of more triangles is shown by a coarse likeness; files stay full</source>
      <translation>Ein Netz aus mehr Dreiecken wird vergröbert gezeigt; Dateien bleiben vollständig</translation>
    </message>
    <message>
      <source>Cell size</source>
      <translation>Zellgröße</translation>
    </message>
    <message>
      <source>Cell type</source>
      <translation>Zelltyp</translation>
    </message>
    <message>
      <source>Colour of cut faces</source>
      <translation>Farbe der Schnittflächen</translation>
    </message>
    <message>
      <source>Colour of overhangs</source>
      <translation>Farbe der Überhänge</translation>
    </message>
    <message>
      <source>Colour of the lattice</source>
      <translation>Farbe des Gitters</translation>
    </message>
    <message>
      <source>Colour of the skin</source>
      <translation>Farbe der Haut</translation>
    </message>
    <message>
      <source>Defaults</source>
      <translation>Voreinstellungen</translation>
    </message>
    <message>
      <source>Density</source>
      <translation>Dichte</translation>
    </message>
    <message>
      <source>Density of the material, from which the mass comes</source>
      <translation>Dichte des Werkstoffs, aus der die Masse folgt</translation>
    </message>
    <message>
      <source>Deviation</source>
      <translation>Abweichung</translation>
    </message>
    <message>
      <source>Display</source>
      <translation>Anzeige</translation>
    </message>
    <message>
      <source>Display and limits</source>
      <translation>Anzeige und Grenzen</translation>
    </message>
    <message>
      <source>Distance between a facet and the exact strut, where the resolution is automatic; automatic: by the strut radius</source>
      <translation>Abstand zwischen einer Facette und der genauen Strebe bei automatischer Auflösung; automatisch: nach dem Strebenradius</translation>
    </message>
    <message>
      <source>Edge length L of a cell; automatic: about four cells across the thinnest side of the part</source>
      <translation>Kantenlänge L einer Zelle; automatisch: etwa vier Zellen über die dünnste Seite des Bauteils</translation>
    </message>
    <message>
      <source>Facets along the edge of a cell; automatic: chosen by the deviation</source>
      <translation>Facetten entlang der Kante einer Zelle; automatisch: nach der Abweichung gewählt</translation>
    </message>
    <message>
      <source>For searching nearest points, measuring meshes and writing STL files, and at most so many processes that fill a part; automatic: one on each core</source>
      <translation>Zum Suchen nächster Punkte, Messen von Netzen und Schreiben von STL-Dateien, und höchstens so viele Prozesse, die ein Bauteil füllen; automatisch: einer auf jedem Kern</translation>
    </message>
    <message>
      <source>In Section View</source>
      <translation>In der Schnittansicht</translation>
    </message>
    <message>
      <source>Lattice</source>
      <translation>Gitter</translation>
    </message>
    <message>
      <source>Limits</source>
      <translation>Grenzen</translation>
    </message>
    <message>
      <source>Material</source>
      <translation>Werkstoff</translation>
    </message>
    <message>
      <source>Mesh</source>
      <translation>Netz</translation>
    </message>
    <message>
      <source>More struts than these are drawn as lines, in the preview and in the display mode Simplified</source>
      <translation>Mehr Streben als diese werden als Linien gezeichnet, in der Vorschau und in der Darstellung Simplified</translation>
    </message>
    <message>
      <source>New infill</source>
      <translation>Neue Füllung</translation>
    </message>
    <message>
      <source>Of a new infill</source>
      <translation>Einer neuen Füllung</translation>
    </message>
    <message>
      <source>Of a new infill, so that the lattice is seen through the skin</source>
      <translation>Einer neuen Füllung, damit das Gitter durch die Haut zu sehen ist</translation>
    </message>
    <message>
      <source>Of a new print check</source>
      <translation>Einer neuen Druckprüfung</translation>
    </message>
    <message>
      <source>Of the material, in your currency, from which the panel tells the cost; 0: no cost is told</source>
      <translation>Des Materials, in Ihrer Währung; daraus sagt das Fenster die Kosten; 0: keine</translation>
    </message>
    <message>
      <source>Price of a kilogram</source>
      <translation>Preis eines Kilogramms</translation>
    </message>
    <message>
      <source>Radius of the struts as a share of the cell size L</source>
      <translation>Radius der Streben als Anteil der Zellgröße L</translation>
    </message>
    <message>
      <source>Resolution</source>
      <translation>Auflösung</translation>
    </message>
    <message>
      <source>Show the values that VOLFREP comes with</source>
      <translation>Zeigt die Werte, mit denen VOLFREP kommt</translation>
    </message>
    <message>
      <source>Skin thickness</source>
      <translation>Hautdicke</translation>
    </message>
    <message>
      <source>Strut radius</source>
      <translation>Strebenradius</translation>
    </message>
    <message>
      <source>Struts to show as solids</source>
      <translation>Körperlich gezeigte Streben</translation>
    </message>
    <message>
      <source>The property AutoUpdate of a new infill; without it, use Update Lattice Infill</source>
      <translation>Die Eigenschaft AutoUpdate einer neuen Füllung; ohne sie wird Gitterfüllung aktualisieren verwendet</translation>
    </message>
    <message>
      <source>The unit cell of a new infill</source>
      <translation>Die Einheitszelle einer neuen Füllung</translation>
    </message>
    <message>
      <source>Thickness of the closed skin; automatic: a fifth of the cell size</source>
      <translation>Dicke der geschlossenen Haut; automatisch: ein Fünftel der Zellgröße</translation>
    </message>
    <message>
      <source>Threads</source>
      <translation>Threads</translation>
    </message>
    <message>
      <source>Transparency</source>
      <translation>Transparenz</translation>
    </message>
    <message>
      <source>Triangles to show</source>
      <translation>Gezeigte Dreiecke</translation>
    </message>
    <message>
      <source>Triangles to wait at</source>
      <translation>Warten ab Dreiecken</translation>
    </message>
    <message>
      <source>Update at every change</source>
      <translation>Bei jeder Änderung aktualisieren</translation>
    </message>
    <message>
      <source>automatic</source>
      <translation>automatisch</translation>
    </message>
  </context>
  <context>
    <name>VolfrepPrinterFile</name>
    <message>
      <source>As drawn</source>
      <translation>Wie gezeichnet</translation>
    </message>
    <message>
      <source>Diameters: {source}. Yours may differ: print coupons.</source>
      <translation>Durchmesser: {source}. Ihre können anders sein: Proben drucken.</translation>
    </message>
    <message>
      <source>Drawn for the printer</source>
      <translation>Für den Drucker gezeichnet</translation>
    </message>
    <message>
      <source>Largest file</source>
      <translation>Größte Datei</translation>
    </message>
    <message>
      <source>Limits: {source}, read {date}; they may have changed.</source>
      <translation>Grenzen: {source}, gelesen {date}; sie können sich geändert haben.</translation>
    </message>
    <message>
      <source>Measured diameters (*.csv)</source>
      <translation>Gemessene Durchmesser (*.csv)</translation>
    </message>
    <message>
      <source>Most triangles</source>
      <translation>Dreiecke, höchstens</translation>
    </message>
    <message>
      <source>My own limits</source>
      <translation>Eigene Grenzen</translation>
    </message>
    <message>
      <source>My own measurements</source>
      <translation>Eigene Messungen</translation>
    </message>
    <message>
      <source>Service</source>
      <translation>Dienst</translation>
    </message>
    <message>
      <source>Table</source>
      <translation>Tabelle</translation>
    </message>
    <message>
      <source>The mesh has {triangles} triangles, {size} MB as STL.</source>
      <translation>Das Netz hat {triangles} Dreiecke, als STL {size} MB.</translation>
    </message>
    <message>
      <source>no limit</source>
      <translation>keine Grenze</translation>
    </message>
    <message>
      <source>{count} triangles</source>
      <translation>{count} Dreiecke</translation>
    </message>
  </context>
  <context>
    <name>VolfrepProgress</name>
    <message>
      <source>Cancel</source>
      <translation>Abbrechen</translation>
    </message>
    <message>
      <source>Cancelling...</source>
      <translation>Wird abgebrochen...</translation>
    </message>
    <message>
      <source>Stop this job (Esc)</source>
      <translation>Diese Aufgabe abbrechen (Esc)</translation>
    </message>
    <message>
      <source>check</source>
      <translation>Prüfung</translation>
    </message>
    <message>
      <source>crossings</source>
      <translation>Durchdringungen</translation>
    </message>
    <message>
      <source>into the document when you pause</source>
      <translation>ins Dokument, sobald Sie innehalten</translation>
    </message>
    <message>
      <source>lattice</source>
      <translation>Gitter</translation>
    </message>
    <message>
      <source>proof</source>
      <translation>Nachweis</translation>
    </message>
    <message>
      <source>shell</source>
      <translation>Haut</translation>
    </message>
    <message>
      <source>sizing</source>
      <translation>Dimensionieren</translation>
    </message>
    <message>
      <source>skin</source>
      <translation>Haut</translation>
    </message>
    <message>
      <source>tile</source>
      <translation>Kachel</translation>
    </message>
    <message>
      <source>trim</source>
      <translation>Beschnitt</translation>
    </message>
    <message>
      <source>voxels</source>
      <translation>Voxel</translation>
    </message>
    <message>
      <source>waiting</source>
      <translation>wartet</translation>
    </message>
    <message>
      <source>write</source>
      <translation>Schreiben</translation>
    </message>
    <message>
      <source>{done} of {runs} runs, about {time} left</source>
      <translation>{done} von {runs} Läufen, noch etwa {time}</translation>
    </message>
  </context>
  <context>
    <name>VolfrepRecipes</name>
    <message>
      <source>Bone-like</source>
      <translation>Knochenartig</translation>
    </message>
    <message>
      <source>Cushion</source>
      <translation>Polster</translation>
    </message>
    <message>
      <source>Heat sink</source>
      <translation>Kühlkörper</translation>
    </message>
    <message>
      <source>Keep these settings under a name, for other solids and documents</source>
      <translation>Diese Einstellungen unter einem Namen behalten, für andere Körper und Dokumente</translation>
    </message>
    <message>
      <source>Light bracket, LPBF</source>
      <translation>Leichte Halterung, LPBF</translation>
    </message>
    <message>
      <source>Name of these settings:</source>
      <translation>Name dieser Einstellungen:</translation>
    </message>
    <message>
      <source>Recipe</source>
      <translation>Rezept</translation>
    </message>
    <message>
      <source>Recipe...</source>
      <translation>Rezept ...</translation>
    </message>
    <message>
      <source>Save Recipe</source>
      <translation>Rezept speichern</translation>
    </message>
    <message>
      <source>Save...</source>
      <translation>Sichern ...</translation>
    </message>
    <message>
      <source>Start from named settings: VOLFREP's own, and those that you have saved</source>
      <translation>Mit benannten Einstellungen beginnen: denen von VOLFREP und Ihren gespeicherten</translation>
    </message>
  </context>
  <context>
    <name>VolfrepReport</name>
    <message>
      <source>Close</source>
      <translation>Schließen</translation>
    </message>
    <message>
      <source>Copy</source>
      <translation>Kopieren</translation>
    </message>
    <message>
      <source>Domain</source>
      <translation>Füllraum</translation>
    </message>
    <message>
      <source>E along [100]</source>
      <translation>E-Modul längs [100]</translation>
    </message>
    <message>
      <source>E along [110]</source>
      <translation>E-Modul längs [110]</translation>
    </message>
    <message>
      <source>E along [111]</source>
      <translation>E-Modul längs [111]</translation>
    </message>
    <message>
      <source>E along x</source>
      <translation>E entlang x</translation>
    </message>
    <message>
      <source>E along y</source>
      <translation>E entlang y</translation>
    </message>
    <message>
      <source>E along z</source>
      <translation>E entlang z</translation>
    </message>
    <message>
      <source>For printing</source>
      <translation>Für den Druck</translation>
    </message>
    <message>
      <source>FreeCAD's own checks</source>
      <translation>FreeCADs eigene Prüfungen</translation>
    </message>
    <message>
      <source>Inputs</source>
      <translation>Eingaben</translation>
    </message>
    <message>
      <source>Lattice</source>
      <translation>Gitter</translation>
    </message>
    <message>
      <source>Limits</source>
      <translation>Grenzen</translation>
    </message>
    <message>
      <source>Mass</source>
      <translation>Masse</translation>
    </message>
    <message>
      <source>Notes</source>
      <translation>Anmerkungen</translation>
    </message>
    <message>
      <source>Part</source>
      <translation>Bauteil</translation>
    </message>
    <message>
      <source>Peak memory at the end of each stage, MB</source>
      <translation>Höchster Speicher am Ende jedes Schritts, MB</translation>
    </message>
    <message>
      <source>Poisson's ratio</source>
      <translation>Querkontraktionszahl</translation>
    </message>
    <message>
      <source>Result of the last update</source>
      <translation>Ergebnis der letzten Aktualisierung</translation>
    </message>
    <message>
      <source>Save Report</source>
      <translation>Bericht speichern</translation>
    </message>
    <message>
      <source>Save...</source>
      <translation>Speichern...</translation>
    </message>
    <message>
      <source>Seconds by stage</source>
      <translation>Sekunden je Schritt</translation>
    </message>
    <message>
      <source>Skin</source>
      <translation>Haut</translation>
    </message>
    <message>
      <source>Steps</source>
      <translation>Schritte</translation>
    </message>
    <message>
      <source>Struts</source>
      <translation>Streben</translation>
    </message>
    <message>
      <source>Surfaces that run through each other</source>
      <translation>Flächen, die sich durchdringen</translation>
    </message>
    <message>
      <source>The same beams in CalculiX</source>
      <translation>Dieselben Balken in CalculiX</translation>
    </message>
    <message>
      <source>The tables are on the clipboard.</source>
      <translation>Die Tabellen sind in der Zwischenablage.</translation>
    </message>
    <message>
      <source>Triangles and the file's single precision</source>
      <translation>Dreiecke und die einfache Genauigkeit der Datei</translation>
    </message>
    <message>
      <source>What the lattice does</source>
      <translation>Was das Gitter leistet</translation>
    </message>
    <message>
      <source>Zener anisotropy</source>
      <translation>Zener-Anisotropie</translation>
    </message>
    <message>
      <source>a solid</source>
      <translation>ein Volumenkörper</translation>
    </message>
    <message>
      <source>active cells</source>
      <translation>aktive Zellen</translation>
    </message>
    <message>
      <source>all</source>
      <translation>alle</translation>
    </message>
    <message>
      <source>along lines through it</source>
      <translation>entlang von Linien hindurch</translation>
    </message>
    <message>
      <source>area</source>
      <translation>Oberfläche</translation>
    </message>
    <message>
      <source>area, mm2</source>
      <translation>Oberfläche, mm2</translation>
    </message>
    <message>
      <source>as a file holds it</source>
      <translation>wie eine Datei es hält</translation>
    </message>
    <message>
      <source>beams say the most, solids may say the least</source>
      <translation>Balken nennen das Größte, Volumenelemente womöglich das Kleinste</translation>
    </message>
    <message>
      <source>bodies</source>
      <translation>Körper</translation>
    </message>
    <message>
      <source>box</source>
      <translation>Hüllquader</translation>
    </message>
    <message>
      <source>buckling safety</source>
      <translation>Knicksicherheit</translation>
    </message>
    <message>
      <source>buckling, % of its limit</source>
      <translation>Knicken, % der Grenze</translation>
    </message>
    <message>
      <source>build direction</source>
      <translation>Baurichtung</translation>
    </message>
    <message>
      <source>builds without support from, degrees</source>
      <translation>baut ohne Stützen ab, Grad</translation>
    </message>
    <message>
      <source>bulk modulus</source>
      <translation>Kompressionsmodul</translation>
    </message>
    <message>
      <source>cell</source>
      <translation>Zelle</translation>
    </message>
    <message>
      <source>cell size, mm</source>
      <translation>Zellgröße, mm</translation>
    </message>
    <message>
      <source>cells of the grid</source>
      <translation>Zellen des Rasters</translation>
    </message>
    <message>
      <source>check</source>
      <translation>Prüfung</translation>
    </message>
    <message>
      <source>closed</source>
      <translation>geschlossen</translation>
    </message>
    <message>
      <source>closed voids</source>
      <translation>geschlossene Hohlräume</translation>
    </message>
    <message>
      <source>conductivity</source>
      <translation>Leitfähigkeit</translation>
    </message>
    <message>
      <source>confirmed</source>
      <translation>bestätigt</translation>
    </message>
    <message>
      <source>corrupted triangles</source>
      <translation>beschädigte Dreiecke</translation>
    </message>
    <message>
      <source>density</source>
      <translation>Dichte</translation>
    </message>
    <message>
      <source>density, g/cm3</source>
      <translation>Dichte, g/cm3</translation>
    </message>
    <message>
      <source>displacement, % of its limit</source>
      <translation>Verschiebung, % der Grenze</translation>
    </message>
    <message>
      <source>displacements differ by, %</source>
      <translation>Verschiebungen weichen ab um, %</translation>
    </message>
    <message>
      <source>does not hold the limits</source>
      <translation>hält die Grenzen nicht ein</translation>
    </message>
    <message>
      <source>every place inside is enclosed once</source>
      <translation>jede Stelle im Inneren ist einmal umschlossen</translation>
    </message>
    <message>
      <source>every triangle keeps its corners</source>
      <translation>jedes Dreieck behält seine Ecken</translation>
    </message>
    <message>
      <source>flatter ceilings within the skin, mm2</source>
      <translation>flachere Decken innerhalb der Haut, mm2</translation>
    </message>
    <message>
      <source>flatter parts of the outside, mm2</source>
      <translation>flachere Teile der Außenseite, mm2</translation>
    </message>
    <message>
      <source>flatter struts removed</source>
      <translation>flachere Streben entfernt</translation>
    </message>
    <message>
      <source>found</source>
      <translation>gefunden</translation>
    </message>
    <message>
      <source>frame buckling, % of its limit</source>
      <translation>gemeinsames Knicken, % der Grenze</translation>
    </message>
    <message>
      <source>frequency, % of its limit</source>
      <translation>Frequenz, % der Grenze</translation>
    </message>
    <message>
      <source>from</source>
      <translation>ab</translation>
    </message>
    <message>
      <source>genus</source>
      <translation>Geschlecht</translation>
    </message>
    <message>
      <source>governed by</source>
      <translation>maßgebend</translation>
    </message>
    <message>
      <source>invalid points</source>
      <translation>ungültige Punkte</translation>
    </message>
    <message>
      <source>it has not solved this design</source>
      <translation>es hat diesen Entwurf nicht gerechnet</translation>
    </message>
    <message>
      <source>joints</source>
      <translation>Knoten</translation>
    </message>
    <message>
      <source>largest displacement, mm</source>
      <translation>größte Verschiebung, mm</translation>
    </message>
    <message>
      <source>largest radius, mm</source>
      <translation>größter Radius, mm</translation>
    </message>
    <message>
      <source>largest stress of the skin, MPa</source>
      <translation>größte Spannung der Haut, MPa</translation>
    </message>
    <message>
      <source>largest stress, CalculiX / VOLFREP</source>
      <translation>größte Spannung, CalculiX / VOLFREP</translation>
    </message>
    <message>
      <source>largest stress, MPa</source>
      <translation>größte Spannung, MPa</translation>
    </message>
    <message>
      <source>largest thickness, mm</source>
      <translation>größte Dicke, mm</translation>
    </message>
    <message>
      <source>lattice</source>
      <translation>Gitter</translation>
    </message>
    <message>
      <source>least strength along x, y, z</source>
      <translation>kleinste Festigkeit entlang x, y, z</translation>
    </message>
    <message>
      <source>limit</source>
      <translation>Grenze</translation>
    </message>
    <message>
      <source>load before struts buckle together, times</source>
      <translation>Last, bis Streben gemeinsam knicken, Vielfaches</translation>
    </message>
    <message>
      <source>loose pieces removed</source>
      <translation>entfernte lose Teile</translation>
    </message>
    <message>
      <source>lowest frequency, CalculiX / VOLFREP</source>
      <translation>niedrigste Frequenz, CalculiX / VOLFREP</translation>
    </message>
    <message>
      <source>manifold</source>
      <translation>mannigfaltig</translation>
    </message>
    <message>
      <source>mass of the skin, g</source>
      <translation>Masse der Haut, g</translation>
    </message>
    <message>
      <source>mass of the struts, g</source>
      <translation>Masse der Streben, g</translation>
    </message>
    <message>
      <source>mass, g</source>
      <translation>Masse, g</translation>
    </message>
    <message>
      <source>mean radius ratio</source>
      <translation>mittleres Radienverhältnis</translation>
    </message>
    <message>
      <source>mean thickness, mm</source>
      <translation>mittlere Dicke, mm</translation>
    </message>
    <message>
      <source>most</source>
      <translation>höchster Wert</translation>
    </message>
    <message>
      <source>most stressed strut, at x, y, z</source>
      <translation>höchstbelastete Strebe, bei x, y, z</translation>
    </message>
    <message>
      <source>most used limit</source>
      <translation>am meisten genutzte Grenze</translation>
    </message>
    <message>
      <source>no</source>
      <translation>nein</translation>
    </message>
    <message>
      <source>non-manifold edges or points</source>
      <translation>nicht mannigfaltige Kanten oder Punkte</translation>
    </message>
    <message>
      <source>none</source>
      <translation>keine</translation>
    </message>
    <message>
      <source>not compared in CalculiX</source>
      <translation>in CalculiX nicht verglichen</translation>
    </message>
    <message>
      <source>of that solid, g</source>
      <translation>davon massiv, g</translation>
    </message>
    <message>
      <source>on 90% of its area</source>
      <translation>auf 90% ihrer Fläche</translation>
    </message>
    <message>
      <source>on all but 0.1% of its area</source>
      <translation>auf allem außer 0,1% ihrer Fläche</translation>
    </message>
    <message>
      <source>one radius, as near as it gets</source>
      <translation>ein Radius, so nah es geht</translation>
    </message>
    <message>
      <source>one radius, one skin</source>
      <translation>ein Radius, eine Haut</translation>
    </message>
    <message>
      <source>one radius, same limits</source>
      <translation>ein Radius, gleiche Grenzen</translation>
    </message>
    <message>
      <source>one radius, same mass</source>
      <translation>ein Radius, gleiche Masse</translation>
    </message>
    <message>
      <source>output</source>
      <translation>Ausgabe</translation>
    </message>
    <message>
      <source>radius list</source>
      <translation>Liste der Radien</translation>
    </message>
    <message>
      <source>radius, mm</source>
      <translation>Radius, mm</translation>
    </message>
    <message>
      <source>relative density</source>
      <translation>relative Dichte</translation>
    </message>
    <message>
      <source>relative density, %</source>
      <translation>relative Dichte, %</translation>
    </message>
    <message>
      <source>same mass, times as stiff as one radius</source>
      <translation>gleiche Masse, so viele Male so steif wie ein Radius</translation>
    </message>
    <message>
      <source>shear modulus</source>
      <translation>Schubmodul</translation>
    </message>
    <message>
      <source>shear strength</source>
      <translation>Schubfestigkeit</translation>
    </message>
    <message>
      <source>shell</source>
      <translation>Haut</translation>
    </message>
    <message>
      <source>short stubs removed</source>
      <translation>entfernte kurze Stummel</translation>
    </message>
    <message>
      <source>shortest and longest strut, mm</source>
      <translation>kürzeste und längste Strebe, mm</translation>
    </message>
    <message>
      <source>shortest edge</source>
      <translation>kürzeste Kante</translation>
    </message>
    <message>
      <source>sized</source>
      <translation>dimensioniert</translation>
    </message>
    <message>
      <source>skin stress, % of its limit</source>
      <translation>Spannung der Haut, % der Grenze</translation>
    </message>
    <message>
      <source>skin, mm</source>
      <translation>Haut, mm</translation>
    </message>
    <message>
      <source>smallest and largest radius, mm</source>
      <translation>kleinster und größter Radius, mm</translation>
    </message>
    <message>
      <source>smallest angle</source>
      <translation>kleinster Winkel</translation>
    </message>
    <message>
      <source>smallest radius ratio</source>
      <translation>kleinstes Radienverhältnis</translation>
    </message>
    <message>
      <source>smallest radius, mm</source>
      <translation>kleinster Radius, mm</translation>
    </message>
    <message>
      <source>smallest thickness, mm</source>
      <translation>kleinste Dicke, mm</translation>
    </message>
    <message>
      <source>status</source>
      <translation>Status</translation>
    </message>
    <message>
      <source>step</source>
      <translation>Schritt</translation>
    </message>
    <message>
      <source>step of its numbers</source>
      <translation>Schrittweite ihrer Zahlen</translation>
    </message>
    <message>
      <source>strength</source>
      <translation>Festigkeit</translation>
    </message>
    <message>
      <source>strength along x</source>
      <translation>Festigkeit entlang x</translation>
    </message>
    <message>
      <source>strength along y</source>
      <translation>Festigkeit entlang y</translation>
    </message>
    <message>
      <source>strength along z</source>
      <translation>Festigkeit entlang z</translation>
    </message>
    <message>
      <source>stress, % of its limit</source>
      <translation>Spannung, % der Grenze</translation>
    </message>
    <message>
      <source>strut radius, mm</source>
      <translation>Strebenradius, mm</translation>
    </message>
    <message>
      <source>struts</source>
      <translation>Streben</translation>
    </message>
    <message>
      <source>struts removed, free end</source>
      <translation>entfernte Streben, freies Ende</translation>
    </message>
    <message>
      <source>thickness there, % of what was asked</source>
      <translation>Dicke im Teil, % der verlangten</translation>
    </message>
    <message>
      <source>thin struts removed</source>
      <translation>dünne Streben entfernt</translation>
    </message>
    <message>
      <source>through-holes</source>
      <translation>Durchgangslöcher</translation>
    </message>
    <message>
      <source>tile</source>
      <translation>Kachel</translation>
    </message>
    <message>
      <source>triangles</source>
      <translation>Dreiecke</translation>
    </message>
    <message>
      <source>triangles that cross</source>
      <translation>Dreiecke, die sich durchdringen</translation>
    </message>
    <message>
      <source>trim</source>
      <translation>Beschnitt</translation>
    </message>
    <message>
      <source>vertices</source>
      <translation>Eckpunkte</translation>
    </message>
    <message>
      <source>voids</source>
      <translation>Hohlräume</translation>
    </message>
    <message>
      <source>volume</source>
      <translation>Volumen</translation>
    </message>
    <message>
      <source>volume, mm3</source>
      <translation>Volumen, mm3</translation>
    </message>
    <message>
      <source>voxels</source>
      <translation>Voxel</translation>
    </message>
    <message>
      <source>watertight</source>
      <translation>wasserdicht</translation>
    </message>
    <message>
      <source>with the skin</source>
      <translation>mit der Haut</translation>
    </message>
    <message>
      <source>with the struts removed</source>
      <translation>mit den entfernten Streben</translation>
    </message>
    <message>
      <source>work of the loads, N mm</source>
      <translation>Arbeit der Lasten, N mm</translation>
    </message>
    <message>
      <source>wrong neighbours</source>
      <translation>falsche Nachbarn</translation>
    </message>
    <message>
      <source>wrongly oriented triangles</source>
      <translation>falsch gerichtete Dreiecke</translation>
    </message>
    <message>
      <source>yes</source>
      <translation>ja</translation>
    </message>
  </context>
  <context>
    <name>VolfrepSectionView</name>
    <message>
      <source>Across</source>
      <translation>Quer zu</translation>
    </message>
    <message>
      <source>Other side</source>
      <translation>Andere Seite</translation>
    </message>
    <message>
      <source>Section of {label}</source>
      <translation>Schnitt von {label}</translation>
    </message>
    <message>
      <source>The axis that the plane lies across</source>
      <translation>Die Achse, zu der die Ebene quer liegt</translation>
    </message>
  </context>
  <context>
    <name>VolfrepSentences</name>
    <message>
      <source>'{element}' has no direction: pick a straight or a round edge, a plane or a round face, an axis or a plane.</source>
      <translation>'{element}' hat keine Richtung: eine gerade oder runde Kante, eine ebene oder runde Fläche, eine Achse oder eine Ebene wählen.</translation>
    </message>
    <message>
      <source>'{element}' has no middle: pick a vertex, edge or face.</source>
      <translation>'{element}' hat keine Mitte: eine Ecke, Kante oder Fläche wählen.</translation>
    </message>
    <message>
      <source>'{element}' is no face of the part: pick faces of it, or another solid.</source>
      <translation>'{element}' ist keine Fläche des Teils: Flächen des Teils oder einen anderen Körper wählen.</translation>
    </message>
    <message>
      <source>'{label}' has no mesh to check: update it first.</source>
      <translation>'{label}' hat kein Netz zum Prüfen: zuerst aktualisieren.</translation>
    </message>
    <message>
      <source>'{label}' has no mesh to export: update it first.</source>
      <translation>'{label}' hat kein Netz zum Exportieren: zuerst aktualisieren.</translation>
    </message>
    <message>
      <source>'{label}' holds no lattice: set its Output to part.</source>
      <translation>'{label}' enthält kein Gitter: sein Ergebnis (Output) auf Part setzen.</translation>
    </message>
    <message>
      <source>'{label}' is a {shape} without a solid: choose a solid, or close it and convert it to one (Part &gt; Convert to solid).</source>
      <translation>'{label}' hat Flächen ({shape}), aber keinen Körper: einen Körper wählen, oder sie schließen und umwandeln (Part &gt; In Festkörper umwandeln).</translation>
    </message>
    <message>
      <source>'{label}' is no solid: choose one.</source>
      <translation>'{label}' ist kein Festkörper: einen wählen.</translation>
    </message>
    <message>
      <source>'{label}' is not a lattice infill: choose one.</source>
      <translation>'{label}' ist keine Gitterfüllung: eine wählen.</translation>
    </message>
    <message>
      <source>'{label}' is out of date: recompute it first.</source>
      <translation>'{label}' ist nicht aktuell: zuerst neu berechnen.</translation>
    </message>
    <message>
      <source>'{label}' is out of date: update it first.</source>
      <translation>'{label}' ist nicht aktuell: zuerst aktualisieren.</translation>
    </message>
    <message>
      <source>'{label}' refers to no face, edge or vertex: choose some of the part's.</source>
      <translation>'{label}' bezieht sich auf keine Fläche, Kante oder Ecke: welche des Teils wählen.</translation>
    </message>
    <message>
      <source>0: it carries nothing that way</source>
      <translation>0: in dieser Richtung trägt die Zelle nichts</translation>
    </message>
    <message>
      <source>1 closed void holds {volume} mm3 of unused material: open each with a hole of {hole} mm or more.</source>
      <translation>1 geschlossener Hohlraum hält {volume} mm3 ungenutztes Material: ihn mit einem Loch von {hole} mm oder mehr öffnen.</translation>
    </message>
    <message>
      <source>A network along faces has none: pick one or two of the solid as NetworkFaces.</source>
      <translation>Ein Netzwerk entlang Flächen hat keine: eine oder zwei des Körpers als NetworkFaces wählen.</translation>
    </message>
    <message>
      <source>A resolution of {given} is too coarse for struts of radius {radius} mm, which would not have their volume: {facets} facets along a cell are made.</source>
      <translation>Eine Auflösung von {given} ist zu grob für Streben mit Radius {radius} mm, die nicht ihr Volumen hätten: Es werden {facets} Facetten je Zelle erzeugt.</translation>
    </message>
    <message>
      <source>A stiffness that drives the radius is that of a material: choose one for the infill.</source>
      <translation>Eine Steifigkeit, die den Radius bestimmt, ist die eines Werkstoffs: einen für die Füllung wählen.</translation>
    </message>
    <message>
      <source>All figures are of struts as printed ({table}), {thin} to {thick} mm thick; drawn are {least} to {most} mm, {mass} g.</source>
      <translation>Alle Werte gelten für Streben wie gedruckt ({table}), {thin} bis {thick} mm dick; gezeichnet sind {least} bis {most} mm, {mass} g.</translation>
    </message>
    <message>
      <source>All figures are of struts as printed ({table}), {thin} to {thick} mm thick; drawn are {least} to {most} mm, {mass} g; stress and buckling are of struts thinner by {scatters} standard deviations.</source>
      <translation>Alle Werte gelten für Streben wie gedruckt ({table}), {thin} bis {thick} mm dick; gezeichnet sind {least} bis {most} mm, {mass} g; Spannung und Knicken gelten für Streben, die um {scatters} Standardabweichungen dünner sind.</translation>
    </message>
    <message>
      <source>An expression or another object says how '{label}' lies: turn that instead.</source>
      <translation>Ein Ausdruck oder ein anderes Objekt bestimmt die Lage von '{label}': stattdessen das drehen.</translation>
    </message>
    <message>
      <source>Built along none of the part's axes the cell carries without flatter struts: choose another one, such as {cells} with its z upwards.</source>
      <translation>Entlang keiner Achse des Teils gebaut trägt die Zelle ohne flachere Streben: eine andere wählen, etwa {cells} mit z nach oben.</translation>
    </message>
    <message>
      <source>Built along {axis} the lattice carries without flatter struts: choose that build direction where you can.</source>
      <translation>Entlang {axis} gebaut, trägt das Gitter ohne flachere Streben: wenn möglich diese Baurichtung wählen.</translation>
    </message>
    <message>
      <source>Built along {axis} the lattice without flatter struts is {times} times as stiff for its volume: choose that build direction where you can.</source>
      <translation>Entlang {axis} gebaut, ist das Gitter ohne flachere Streben bei gleichem Volumen {times}-mal so steif: wenn möglich diese Baurichtung wählen.</translation>
    </message>
    <message>
      <source>Cancelled: other figures are those of the last finished check, if there was one.</source>
      <translation>Abgebrochen: Die anderen Werte sind die der letzten beendeten Prüfung, falls es eine gab.</translation>
    </message>
    <message>
      <source>Cancelled: the bands are those of the last recompute, if there was one.</source>
      <translation>Abgebrochen: die Bänder sind die der letzten Neuberechnung, wenn es eine gab.</translation>
    </message>
    <message>
      <source>Cancelled: the mesh is that of the last finished update; use Update Lattice Infill to try again.</source>
      <translation>Abgebrochen: das Netz ist das der letzten fertigen Aktualisierung; mit Gitterfüllung aktualisieren noch einmal versuchen.</translation>
    </message>
    <message>
      <source>Cancelled: there is no mesh yet; use Update Lattice Infill to make it.</source>
      <translation>Abgebrochen: es gibt noch kein Netz; mit Gitterfüllung aktualisieren wird es gemacht.</translation>
    </message>
    <message>
      <source>Cancelled: what was done is kept, and the next start goes on from there.</source>
      <translation>Abgebrochen: was fertig ist, bleibt, und der nächste Start fährt dort fort.</translation>
    </message>
    <message>
      <source>Cells of {size} mm are larger than the part, which measures {x} x {y} x {z} mm: reduce the cell size, or see whether the part is in another unit.</source>
      <translation>Zellen von {size} mm sind größer als das Teil, das {x} x {y} x {z} mm misst: die Zellgröße verringern, oder nachsehen, ob das Teil in einer anderen Einheit ist.</translation>
    </message>
    <message>
      <source>Cells of {size} mm are too large for struts of radius {radius} mm: make the cells {largest} mm or smaller, or the struts {thinnest} mm or thicker.</source>
      <translation>Zellen von {size} mm sind zu groß für Streben vom Radius {radius} mm: die Zellen {largest} mm oder kleiner machen, oder die Streben {thinnest} mm oder dicker.</translation>
    </message>
    <message>
      <source>Choose limits, a printer whose struts are known, or both.</source>
      <translation>Grenzen, einen Drucker mit bekannten Streben oder beides wählen.</translation>
    </message>
    <message>
      <source>Every strut has a free end or is too thin, so that none is left: keep dangling and thin struts, reduce the cell size or choose the activation 'touching'.</source>
      <translation>Jede Strebe hat ein freies Ende oder ist zu dünn, so dass keine bleibt: lose und dünne Streben behalten, die Zellgröße verringern oder alle berührenden Zellen behalten.</translation>
    </message>
    <message>
      <source>Every strut lies too flat to be built, or has a free end without those, so that none is left: choose another build direction or cell</source>
      <translation>jede Strebe liegt zu flach zum Bauen oder hat ohne diese ein freies Ende, sodass keine bleibt: eine andere Baurichtung oder Zelle wählen</translation>
    </message>
    <message>
      <source>Failed: see the report view</source>
      <translation>Fehlgeschlagen: siehe die Berichtsansicht</translation>
    </message>
    <message>
      <source>Flat struts hang free over up to {length} mm near {place}, and {process} bridges {most} mm: make the cells smaller or choose another build direction.</source>
      <translation>Flache Streben hängen nahe {place} über bis zu {length} mm frei, und {process} überbrückt {most} mm: die Zellen verkleinern oder eine andere Baurichtung wählen.</translation>
    </message>
    <message>
      <source>Least mass needs a limit: of stress, displacement, buckling, frequency.</source>
      <translation>Die kleinste Masse braucht eine Grenze: für Spannung, Verschiebung, Knicken, Frequenz.</translation>
    </message>
    <message>
      <source>Neither the infill nor its load cases have a material: choose one for the infill.</source>
      <translation>Weder die Füllung noch ihre Lastfälle haben einen Werkstoff: einen für die Füllung wählen.</translation>
    </message>
    <message>
      <source>No TPMS lies inside the skin: reduce the skin thickness.</source>
      <translation>Keine TPMS liegt innerhalb der Haut: die Hautdicke verringern.</translation>
    </message>
    <message>
      <source>No cell of {size} mm has its centre inside the domain: reduce the cell size or choose the activation 'touching'.</source>
      <translation>Keine Zelle von {size} mm hat ihre Mitte im Inneren: die Zellgröße verringern oder alle berührenden Zellen behalten.</translation>
    </message>
    <message>
      <source>No cell of {size} mm lies wholly inside the domain: reduce the cell size or choose the activation 'touching'.</source>
      <translation>Keine Zelle von {size} mm liegt ganz im Inneren: die Zellgröße verringern oder alle berührenden Zellen behalten.</translation>
    </message>
    <message>
      <source>No coupon is chosen: tick at least one.</source>
      <translation>Es ist keine Probe gewählt: mindestens eine ankreuzen.</translation>
    </message>
    <message>
      <source>No heat has a temperature: give one to where the heat leaves.</source>
      <translation>Nirgends ist eine Temperatur gegeben: dort eine angeben, wo die Wärme hinausgeht.</translation>
    </message>
    <message>
      <source>No load case has heat: give faces a temperature or a heat flow.</source>
      <translation>Kein Lastfall hat Wärme: Flächen eine Temperatur oder einen Wärmestrom geben.</translation>
    </message>
    <message>
      <source>No load case is chosen: tick at least one.</source>
      <translation>Kein Lastfall ist gewählt: mindestens einen ankreuzen.</translation>
    </message>
    <message>
      <source>No process is chosen to build for: choose one for the infill.</source>
      <translation>Es ist kein Verfahren gewählt, für das gebaut wird: Wählen Sie eines für die Füllung.</translation>
    </message>
    <message>
      <source>No strut of cells of {size} mm lies inside the skin: reduce the cell size or the skin thickness.</source>
      <translation>Keine Strebe von Zellen von {size} mm liegt innerhalb der Haut: die Zellgröße oder die Hautdicke verringern.</translation>
    </message>
    <message>
      <source>No strut of the network lies inside the skin: reduce the skin thickness.</source>
      <translation>Keine Strebe des Netzwerks liegt innerhalb der Haut: die Hautdicke verringern.</translation>
    </message>
    <message>
      <source>No strut radius gives a mass of {value} with {cells}: choose one from {least} to {most}, of which the skin is {skin}.</source>
      <translation>Kein Strebenradius ergibt eine Masse von {value} mit {cells}: eine von {least} bis {most} wählen, davon ist die Haut {skin}.</translation>
    </message>
    <message>
      <source>No strut radius gives a mass of {value} with {cells}: choose one from {least} to {most}.</source>
      <translation>Kein Strebenradius ergibt eine Masse von {value} mit {cells}: eine von {least} bis {most} wählen.</translation>
    </message>
    <message>
      <source>No strut radius gives a relative density of {value} with {cells}: choose one from {least} to {most}.</source>
      <translation>Kein Strebenradius ergibt eine relative Dichte von {value} mit {cells}: eine von {least} bis {most} wählen.</translation>
    </message>
    <message>
      <source>Not enough memory: choose larger cells or a coarser deviation.</source>
      <translation>Nicht genug Speicher: größere Zellen oder eine gröbere Abweichung wählen.</translation>
    </message>
    <message>
      <source>Not run yet</source>
      <translation>Noch nicht gelaufen</translation>
    </message>
    <message>
      <source>Open faces, drain holes, faces with a skin of their own, and what is kept solid, need a skin that they belong to: give a skin thickness above 0.</source>
      <translation>Offene Flächen, Entleerungslöcher, Flächen mit eigener Haut und was massiv bleibt, brauchen eine Haut, zu der sie gehören: eine Hautdicke über 0 angeben.</translation>
    </message>
    <message>
      <source>Out of date: AutoUpdate is off, use Update Lattice Infill</source>
      <translation>Veraltet: AutoUpdate ist aus, Gitterfüllung aktualisieren verwenden</translation>
    </message>
    <message>
      <source>Out of date: a large job, use Update Lattice Infill</source>
      <translation>Veraltet: eine große Berechnung, Gitterfüllung aktualisieren verwenden</translation>
    </message>
    <message>
      <source>Out of date: the mesh of these values is not there yet</source>
      <translation>Veraltet: das Netz dieser Werte ist noch nicht da</translation>
    </message>
    <message>
      <source>Out of date: values have changed since this mesh was asked for; recompute</source>
      <translation>Veraltet: Werte wurden geändert, seit dieses Netz verlangt wurde; neu berechnen</translation>
    </message>
    <message>
      <source>Out of date: values have changed since this mesh was made; recompute</source>
      <translation>Veraltet: Werte wurden geändert, seit dieses Netz gemacht wurde; neu berechnen</translation>
    </message>
    <message>
      <source>Results of {case}</source>
      <translation>Ergebnisse: {case}</translation>
    </message>
    <message>
      <source>Results were of a wrong type, as another program leaves them: recompute for new ones</source>
      <translation>Ergebnisse waren von falschem Typ, wie ein anderes Programm sie hinterlässt: neu berechnen ergibt neue</translation>
    </message>
    <message>
      <source>Saved by a FreeCAD without VOLFREP: recompute, and whatever was changed there is followed</source>
      <translation>Von einem FreeCAD ohne VOLFREP gespeichert: neu berechnen, dann wird übernommen, was dort geändert wurde</translation>
    </message>
    <message>
      <source>Struts are down to {thin} mm thick near {place}, and {process} wants {least} mm: enlarge the radius.</source>
      <translation>Streben sind nahe {place} nur {thin} mm dick, und {process} verlangt {least} mm: den Radius vergrößern.</translation>
    </message>
    <message>
      <source>Struts are no thinner than {process} prints: {radius} mm in radius.</source>
      <translation>Streben sind nicht dünner, als {process} druckt: {radius} mm Radius.</translation>
    </message>
    <message>
      <source>Struts are only {gap} mm apart near {place}, and {process} wants {least} mm: they may fuse or hold powder; enlarge the cells.</source>
      <translation>Streben sind nahe {place} nur {gap} mm voneinander entfernt, und {process} verlangt {least} mm: Sie können verschmelzen oder Pulver halten; die Zellen vergrößern.</translation>
    </message>
    <message>
      <source>Struts of radius {radius} mm are too thick for a cell of {size} mm: keep the radius below {limit} mm or enlarge the cell.</source>
      <translation>Streben vom Radius {radius} mm sind zu dick für eine Zelle von {size} mm: den Radius unter {limit} mm halten oder die Zelle vergrößern.</translation>
    </message>
    <message>
      <source>Struts of {diameter} mm are thinner than {process} prints: at least {least} mm.</source>
      <translation>Streben von {diameter} mm sind dünner, als {process} druckt: mindestens {least} mm.</translation>
    </message>
    <message>
      <source>Struts that lie flatter than {process} builds stay: {reason}.</source>
      <translation>Streben, die flacher liegen, als {process} baut, bleiben: {reason}.</translation>
    </message>
    <message>
      <source>The Python that goes with this FreeCAD cannot run the engine by itself: runs are done one after the other.</source>
      <translation>Das Python dieses FreeCAD kann den Rechenkern nicht allein ausführen: Die Läufe folgen aufeinander.</translation>
    </message>
    <message>
      <source>The cell type Custom needs a cell: choose its .json file as CellFile.</source>
      <translation>Der Zelltyp Custom braucht eine Zelle: ihre .json-Datei als CellFile wählen.</translation>
    </message>
    <message>
      <source>The document has no load case: make one with Loads and Sizing, or an analysis with the FEM workbench, with constraints on the solid's faces, edges or vertices.</source>
      <translation>Das Dokument hat keinen Lastfall: einen mit Lasten und Auslegung anlegen, oder eine Analyse mit dem FEM-Arbeitsbereich, mit Randbedingungen an Flächen, Kanten oder Ecken des Körpers.</translation>
    </message>
    <message>
      <source>The engine failed with a {kind} ({error}), which is a defect of VOLFREP: please report it with the traceback in the report view's log messages.</source>
      <translation>Der Rechenkern endete mit einem {kind} ({error}), einem Fehler von VOLFREP: bitte mit dem Traceback aus den Log-Meldungen der Ausgabeansicht melden.</translation>
    </message>
    <message>
      <source>The expression '{expression}' of {name} has no value ({reason}): correct it.</source>
      <translation>Der Ausdruck '{expression}' von {name} hat keinen Wert ({reason}): berichtigen.</translation>
    </message>
    <message>
      <source>The infill of this study has gone: choose another one as Infill.</source>
      <translation>Die Füllung dieser Studie gibt es nicht mehr: eine andere als Infill wählen.</translation>
    </message>
    <message>
      <source>The lattice is {bodies} bodies that do not touch each other: only the part's skin holds them together.</source>
      <translation>Das Gitter besteht aus {bodies} Körpern, die sich nicht berühren: Nur die Haut des Teils hält sie zusammen.</translation>
    </message>
    <message>
      <source>The load cases have heat alone: hold faces and load some, too.</source>
      <translation>Die Lastfälle haben nur Wärme: auch Flächen halten und andere belasten.</translation>
    </message>
    <message>
      <source>The material Custom needs a file: choose its .toml or .json file as MaterialFile.</source>
      <translation>Der Werkstoff Custom braucht eine Datei: seine .toml- oder .json-Datei als MaterialFile wählen.</translation>
    </message>
    <message>
      <source>The mesh of '{label}' is out of date ({why}): recompute it for a present one.</source>
      <translation>Das Netz von '{label}' ist nicht aktuell ({why}): neu berechnen, um ein aktuelles zu haben.</translation>
    </message>
    <message>
      <source>The part is nowhere thicker than two skins of {shell} mm, so that nothing is left to fill: reduce the skin thickness.</source>
      <translation>Das Teil ist nirgends dicker als zwei Häute von {shell} mm, so dass nichts zu füllen bleibt: die Hautdicke verringern.</translation>
    </message>
    <message>
      <source>The skin and what is kept solid leave nothing to fill: reduce the skin thickness, that of faces with their own, or what is kept solid.</source>
      <translation>Die Haut und was massiv bleibt, lassen nichts zu füllen: die Hautdicke verringern, die von Flächen mit eigener, oder was massiv bleibt.</translation>
    </message>
    <message>
      <source>The skin is no thinner than {process} prints: {wall} mm.</source>
      <translation>Die Haut ist nicht dünner, als {process} druckt: {wall} mm.</translation>
    </message>
    <message>
      <source>The solid's conductivity is not known: type it in Loads and Sizing, W/(m K).</source>
      <translation>Die Leitfähigkeit des Werkstoffs ist nicht bekannt: sie in Lasten und Auslegung eingeben, W/(m K).</translation>
    </message>
    <message>
      <source>The void about {place} has room for {room} of its {wanted} drain holes: choose a smaller diameter, or give their places.</source>
      <translation>Der Hohlraum um {place} hat Platz für {room} seiner {wanted} Entleerungslöcher: einen kleineren Durchmesser wählen oder ihre Orte angeben.</translation>
    </message>
    <message>
      <source>There is no lattice infill: make one of a solid first.</source>
      <translation>Es gibt keine Gitterfüllung: zuerst eine aus einem Festkörper erzeugen.</translation>
    </message>
    <message>
      <source>There is no solid to fill: choose one as Base.</source>
      <translation>Es gibt keinen Körper zu füllen: einen als Base wählen.</translation>
    </message>
    <message>
      <source>There is no solid to print: choose one as Base.</source>
      <translation>Es gibt keinen Festkörper zum Drucken: einen als Base wählen.</translation>
    </message>
    <message>
      <source>There is nothing to look at: choose a lattice infill as Infill.</source>
      <translation>Es gibt nichts zu prüfen: eine Gitterfüllung als Infill wählen.</translation>
    </message>
    <message>
      <source>There is nothing to vary: choose a lattice infill as Infill.</source>
      <translation>Es gibt nichts zu variieren: eine Gitterfüllung als Infill wählen.</translation>
    </message>
    <message>
      <source>Two load cases have heat, '{one}' and '{other}': choose one, or suppress the heat of the other.</source>
      <translation>Zwei Lastfälle haben Wärme, '{one}' und '{other}': einen wählen, oder die Wärme des anderen unterdrücken.</translation>
    </message>
    <message>
      <source>Up to date</source>
      <translation>Aktuell</translation>
    </message>
    <message>
      <source>Walls are down to {wall} mm thick in every cell, and {process} wants {least} mm: make them thicker, or enlarge the cells of a skeleton.</source>
      <translation>Wände sind in jeder Zelle nur {wall} mm dick, und {process} verlangt {least} mm: sie dicker machen oder die Zellen eines Skeletts vergrößern.</translation>
    </message>
    <message>
      <source>Walls are only {gap} mm apart in every cell, and {process} wants {least} mm: they may fuse or hold powder; make them thinner, or enlarge the cells.</source>
      <translation>Wände sind in jeder Zelle nur {gap} mm voneinander entfernt, und {process} verlangt {least} mm: Sie können verschmelzen oder Pulver halten; sie dünner machen oder die Zellen vergrößern.</translation>
    </message>
    <message>
      <source>Walls of {thickness} mm are too thick for a cell of {size} mm: reduce the thickness or enlarge the cell.</source>
      <translation>Wände von {thickness} mm sind zu dick für eine Zelle von {size} mm: die Dicke verringern oder die Zelle vergrößern.</translation>
    </message>
    <message>
      <source>as even: {density} % everywhere would take the same</source>
      <translation>gleichmäßig: {density} % überall bräuchten gleich viel</translation>
    </message>
    <message>
      <source>band {number}: {mean} % of {volume} mm3, told as {told} %</source>
      <translation>Band {number}: {mean} % von {volume} mm3, genannt als {told} %</translation>
    </message>
    <message>
      <source>band {number}: {mean} % of {volume} mm3, told as {told} % (narrow: joined ends of lines make up the rest)</source>
      <translation>Band {number}: {mean} % von {volume} mm3, genannt als {told} % (schmal: verbundene Linienenden ergeben den Rest)</translation>
    </message>
    <message>
      <source>below {angle} degrees</source>
      <translation>unter {angle} Grad</translation>
    </message>
    <message>
      <source>cells '{cell}' of {size} mm</source>
      <translation>Zellen '{cell}' von {size} mm</translation>
    </message>
    <message>
      <source>closed voids</source>
      <translation>geschlossene Hohlräume</translation>
    </message>
    <message>
      <source>filament: {volume} mm3, {mass} g</source>
      <translation>Filament: {volume} mm3, {mass} g</translation>
    </message>
    <message>
      <source>findings</source>
      <translation>Befunde</translation>
    </message>
    <message>
      <source>inclinations</source>
      <translation>Neigungen</translation>
    </message>
    <message>
      <source>its present values cannot be computed</source>
      <translation>seine jetzigen Werte lassen sich nicht berechnen</translation>
    </message>
    <message>
      <source>largest ball that gets out</source>
      <translation>größte Kugel, die herauskommt</translation>
    </message>
    <message>
      <source>limits from</source>
      <translation>Grenzen aus</translation>
    </message>
    <message>
      <source>longest flat</source>
      <translation>längste flache</translation>
    </message>
    <message>
      <source>longest of these</source>
      <translation>längste davon</translation>
    </message>
    <message>
      <source>mass</source>
      <translation>Masse</translation>
    </message>
    <message>
      <source>narrowest gap</source>
      <translation>engster Spalt</translation>
    </message>
    <message>
      <source>none</source>
      <translation>keine</translation>
    </message>
    <message>
      <source>over {value} (limit {limit})</source>
      <translation>über {value} (Grenze {limit})</translation>
    </message>
    <message>
      <source>process</source>
      <translation>Verfahren</translation>
    </message>
    <message>
      <source>solid: {volume} mm3 of walls and solid layers</source>
      <translation>massiv: {volume} mm3 Wände und volle Schichten</translation>
    </message>
    <message>
      <source>surface</source>
      <translation>Oberfläche</translation>
    </message>
    <message>
      <source>thinnest strut</source>
      <translation>dünnste Strebe</translation>
    </message>
    <message>
      <source>thinnest wall</source>
      <translation>dünnste Wand</translation>
    </message>
    <message>
      <source>values or the solid have changed since it was made</source>
      <translation>Werte oder der Körper haben sich geändert, seit es gemacht wurde</translation>
    </message>
    <message>
      <source>what it is made of has changed and is not recomputed yet</source>
      <translation>woraus es gemacht ist, hat sich geändert und ist noch nicht neu berechnet</translation>
    </message>
    <message>
      <source>without them the limits cannot be held</source>
      <translation>ohne sie sind die Grenzen nicht einzuhalten</translation>
    </message>
    <message>
      <source>{active} of {total} cells, {triangles} triangles, {mass} g in {seconds} s</source>
      <translation>{active} von {total} Zellen, {triangles} Dreiecke, {mass} g in {seconds} s</translation>
    </message>
    <message>
      <source>{classes} % from 0 to 90 degrees, by {step}</source>
      <translation>{classes} % von 0 bis 90 Grad, je {step}</translation>
    </message>
    <message>
      <source>{count} cells are too many to be shown as lines: enlarge the cells.</source>
      <translation>{count} Zellen sind zu viele, um als Linien gezeigt zu werden: die Zellen vergrößern.</translation>
    </message>
    <message>
      <source>{count} closed voids hold {volume} mm3 of unused material: open each with a hole of {hole} mm or more.</source>
      <translation>{count} geschlossene Hohlräume halten {volume} mm3 ungenutztes Material: jeden mit einem Loch von {hole} mm oder mehr öffnen.</translation>
    </message>
    <message>
      <source>{count}, holding {volume} mm3</source>
      <translation>{count}, mit {volume} mm3</translation>
    </message>
    <message>
      <source>{designs} designs of {infill}</source>
      <translation>{designs} Entwürfe von {infill}</translation>
    </message>
    <message>
      <source>{figure} E of the solid</source>
      <translation>{figure} des E-Moduls des Werkstoffs</translation>
    </message>
    <message>
      <source>{figure} of the solid's</source>
      <translation>{figure} von der des Werkstoffs</translation>
    </message>
    <message>
      <source>{figure} of the solid's yield stress</source>
      <translation>{figure} der Streckgrenze des Werkstoffs</translation>
    </message>
    <message>
      <source>{material} is printed by {processes}, not by {process}.</source>
      <translation>{material} wird mit {processes} gedruckt, nicht mit {process}.</translation>
    </message>
    <message>
      <source>{name} has no values: write them as 6, 8, 10 or as 6 to 10 in 5.</source>
      <translation>{name} hat keine Werte: als 6, 8, 10 oder als 6 to 10 in 5 schreiben.</translation>
    </message>
    <message>
      <source>{process} builds {degrees} degrees and more without support, and {area} mm2 of ceilings within its skin, which only struts hold, are flatter, as at {place}: another build direction may have less.</source>
      <translation>{process} baut ab {degrees} Grad ohne Stützen, und {area} mm2 der Decken innerhalb der Haut, die nur Streben halten, sind flacher, etwa bei {place}: Eine andere Baurichtung hat vielleicht weniger davon.</translation>
    </message>
    <message>
      <source>{process} builds {degrees} degrees and more without support, and {area} mm2 of the part's outside are flatter, as at {place}: another build direction may have less.</source>
      <translation>{process} baut ab {degrees} Grad ohne Stützen, und {area} mm2 der Außenseite sind flacher, etwa bei {place}: Eine andere Baurichtung hat vielleicht weniger davon.</translation>
    </message>
    <message>
      <source>{removed} pieces that hang on nothing left out, {share} % of the lattice's volume: smaller cells or another origin may join them, and so does a skin.</source>
      <translation>{removed} Stücke, die an nichts hängen, sind weggelassen, {share} % des Gittervolumens: Kleinere Zellen oder ein anderer Ursprung verbinden sie vielleicht, eine Haut sicher.</translation>
    </message>
    <message>
      <source>{share} % of the struts' length is less than {inclination} degrees above the build plate: choose another build direction or cell, or count on sagging undersides.</source>
      <translation>{share} % der Strebenlänge liegt flacher als {inclination} Grad zur Bauplatte: eine andere Baurichtung oder Zelle wählen oder mit durchhängenden Unterseiten rechnen.</translation>
    </message>
    <message>
      <source>{share} % of the struts' length, {area}</source>
      <translation>{share} % der Strebenlänge, {area}</translation>
    </message>
    <message>
      <source>{solid} has no material in FreeCAD: give it one, or choose another for the infill.</source>
      <translation>{solid} hat in FreeCAD keinen Werkstoff: ihm einen geben, oder einen anderen für die Füllung wählen.</translation>
    </message>
    <message>
      <source>{value} (limit {limit})</source>
      <translation>{value} (Grenze {limit})</translation>
    </message>
  </context>
  <context>
    <name>VolfrepSizePanel</name>
    <message>
      <source>A .csv file with the columns inclination, nominal, measured, as Coupons makes</source>
      <translation>Eine .csv-Datei mit den Spalten inclination, nominal, measured, wie der Befehl Proben sie anlegt</translation>
    </message>
    <message>
      <source>All limits are held.</source>
      <translation>Alle Grenzen sind eingehalten.</translation>
    </message>
    <message>
      <source>All limits are held; one radius and one thickness for all would weigh {even:.4g} g.</source>
      <translation>Alle Grenzen sind eingehalten; mit einem Radius und einer Dicke für alles wären es {even:.4g} g.</translation>
    </message>
    <message>
      <source>Analyses of the FEM workbench: each is a load case</source>
      <translation>Analysen des FEM-Arbeitsbereichs: jede ist ein Lastfall</translation>
    </message>
    <message>
      <source>As drawn, or as this printer makes them: stress, stiffness and mass are then of struts as printed, and the radii found are those to draw</source>
      <translation>Wie gezeichnet, oder wie dieser Drucker sie macht: Spannung, Steifigkeit und Masse gelten dann für Streben wie gedruckt, und die gefundenen Radien sind die zu zeichnenden</translation>
    </message>
    <message>
      <source>Buckling safety</source>
      <translation>Knicksicherheit</translation>
    </message>
    <message>
      <source>CalculiX does not confirm this design: see its notes.</source>
      <translation>CalculiX bestätigt diesen Entwurf nicht: siehe seine Hinweise.</translation>
    </message>
    <message>
      <source>CalculiX's displacements of the same beams and skin differ by {off:.2g} %.</source>
      <translation>Die Verschiebungen von CalculiX für dieselben Balken und dieselbe Haut weichen um {off:.2g} % ab.</translation>
    </message>
    <message>
      <source>CalculiX's displacements of the same beams differ by {off:.2g} %.</source>
      <translation>Die Verschiebungen von CalculiX für dieselben Balken weichen um {off:.2g} % ab.</translation>
    </message>
    <message>
      <source>Cancelled before the first step.</source>
      <translation>Vor dem ersten Schritt abgebrochen.</translation>
    </message>
    <message>
      <source>Check with CalculiX</source>
      <translation>Mit CalculiX prüfen</translation>
    </message>
    <message>
      <source>Conductivity</source>
      <translation>Leitfähigkeit</translation>
    </message>
    <message>
      <source>Displacement</source>
      <translation>Verschiebung</translation>
    </message>
    <message>
      <source>Find radii</source>
      <translation>Radien suchen</translation>
    </message>
    <message>
      <source>Find temperatures</source>
      <translation>Temperaturen suchen</translation>
    </message>
    <message>
      <source>Find the radii now and stay in this panel; Cancel in the status bar keeps the best design so far</source>
      <translation>Die Radien jetzt finden und in diesem Fenster bleiben; Abbrechen in der Statusleiste behält den bisher besten Entwurf</translation>
    </message>
    <message>
      <source>Find the temperatures of the lattice as it is, and colour it</source>
      <translation>Die Temperaturen des Gitters, wie es ist, finden und es danach einfärben</translation>
    </message>
    <message>
      <source>For printing</source>
      <translation>Für den Druck</translation>
    </message>
    <message>
      <source>For {process}, built along {direction}: {count} struts that lie flatter than {degrees} degrees were taken away.</source>
      <translation>Für {process}, gebaut entlang {direction}: {count} Streben, die flacher als {degrees} Grad liegen, wurden entfernt.</translation>
    </message>
    <message>
      <source>Frequency, Hz</source>
      <translation>Frequenz, Hz</translation>
    </message>
    <message>
      <source>Goal</source>
      <translation>Ziel</translation>
    </message>
    <message>
      <source>Goal and limits</source>
      <translation>Ziel und Grenzen</translation>
    </message>
    <message>
      <source>Heat enters and leaves through these faces alone: none is lost to air.</source>
      <translation>Wärme kommt und geht nur durch diese Flächen: an die Luft geht keine verloren.</translation>
    </message>
    <message>
      <source>How many times the load may be before struts buckle, one alone or together; 0 for no limit</source>
      <translation>Wievielmal so groß die Last sein darf, bevor Streben knicken, eine allein oder zusammen; 0 für keine Grenze</translation>
    </message>
    <message>
      <source>How mass and limits went, step by step</source>
      <translation>Wie Masse und Grenzen verliefen, Schritt für Schritt</translation>
    </message>
    <message>
      <source>Largest radius</source>
      <translation>Größter Radius</translation>
    </message>
    <message>
      <source>Least mass</source>
      <translation>Geringste Masse</translation>
    </message>
    <message>
      <source>Let CalculiX solve the design, where it is installed, and say how far it agrees; where it finds more than a limit allows, the struts are made thicker</source>
      <translation>Den Entwurf von CalculiX lösen lassen, wo es installiert ist, und sagen, wie weit es übereinstimmt; wo es mehr findet, als eine Grenze erlaubt, werden die Streben dicker</translation>
    </message>
    <message>
      <source>Load cases</source>
      <translation>Lastfälle</translation>
    </message>
    <message>
      <source>Loads and Sizing: {label}</source>
      <translation>Lasten und Auslegung: {label}</translation>
    </message>
    <message>
      <source>Mass, g</source>
      <translation>Masse, g</translation>
    </message>
    <message>
      <source>Most stiffness</source>
      <translation>Größte Steifigkeit</translation>
    </message>
    <message>
      <source>Most used limit</source>
      <translation>Meistgenutzte Grenze</translation>
    </message>
    <message>
      <source>Nodes whose struts would grow together stay below it</source>
      <translation>Knoten, deren Streben zusammenwachsen würden, bleiben darunter</translation>
    </message>
    <message>
      <source>Of the skin {solid:.4g} g are solid from side to side.</source>
      <translation>Von der Haut sind {solid:.4g} g massiv von Seite zu Seite.</translation>
    </message>
    <message>
      <source>Of the solid material, as its data sheet says</source>
      <translation>Des massiven Werkstoffs, wie sein Datenblatt sie angibt</translation>
    </message>
    <message>
      <source>Plot</source>
      <translation>Diagramm</translation>
    </message>
    <message>
      <source>Remove struts that carry little</source>
      <translation>Wenig tragende Streben weg</translation>
    </message>
    <message>
      <source>Size the skin, too, from this thickness on; 0 leaves it as it is</source>
      <translation>Auch die Haut bemessen, ab dieser Dicke; 0 lässt sie, wie sie ist</translation>
    </message>
    <message>
      <source>Smallest radius</source>
      <translation>Kleinster Radius</translation>
    </message>
    <message>
      <source>Standard deviations</source>
      <translation>Standardabweichungen</translation>
    </message>
    <message>
      <source>Steady heat</source>
      <translation>Stationäre Wärme</translation>
    </message>
    <message>
      <source>Step</source>
      <translation>Schritt</translation>
    </message>
    <message>
      <source>Steps of {label}</source>
      <translation>Schritte von {label}</translation>
    </message>
    <message>
      <source>Stress and buckling are of struts thinner by so many standard deviations of the table</source>
      <translation>Spannung und Knicken gelten für Streben, die um so viele Standardabweichungen der Tabelle dünner sind</translation>
    </message>
    <message>
      <source>Struts</source>
      <translation>Streben</translation>
    </message>
    <message>
      <source>Struts and skin no thinner than the process prints, and none flatter as far as limits allow</source>
      <translation>Streben und Haut nicht dünner, als das Verfahren druckt, und keine Strebe flacher, soweit die Grenzen es erlauben</translation>
    </message>
    <message>
      <source>Struts of {mass:.4g} g hold all limits; no one radius between these does.</source>
      <translation>Streben von {mass:.4g} g halten alle Grenzen ein; kein einheitlicher Radius dazwischen tut das.</translation>
    </message>
    <message>
      <source>Struts of {mass:.4g} g hold all limits; of one radius they would weigh {even:.4g} g.</source>
      <translation>Streben von {mass:.4g} g halten alle Grenzen ein; mit einem einheitlichen Radius wögen sie {even:.4g} g.</translation>
    </message>
    <message>
      <source>Struts of {mass:.4g} g, {least:.3g} to {gain:.3g} times as stiff as struts of one radius and the same mass.</source>
      <translation>Streben von {mass:.4g} g, {least:.3g}- bis {gain:.3g}-mal so steif wie Streben eines einheitlichen Radius mit derselben Masse.</translation>
    </message>
    <message>
      <source>Struts of {struts:.4g} g and a skin of {low:.3g} to {high:.3g} mm, {skin:.4g} g.</source>
      <translation>Streben von {struts:.4g} g und eine Haut von {low:.3g} bis {high:.3g} mm, {skin:.4g} g.</translation>
    </message>
    <message>
      <source>Take away struts that end as thin as the smallest radius and size the rest again; kept if that is lighter, or stiffer at the same mass</source>
      <translation>Streben wegnehmen, die so dünn wie der kleinste Radius enden, und den Rest neu auslegen; behalten, wenn das leichter ist, oder steifer bei gleicher Masse</translation>
    </message>
    <message>
      <source>Temperatures are {low} to {high} °C, {flow} W flow through.</source>
      <translation>Die Temperaturen sind {low} bis {high} °C, {flow} W fließen hindurch.</translation>
    </message>
    <message>
      <source>The largest of any point under any case; 0 for no limit</source>
      <translation>Die größte jedes Punktes in jedem Fall; 0 für keine Grenze</translation>
    </message>
    <message>
      <source>The limit of {limit} cannot be held between these radii: {use:.0%} of it is used. Allow thicker struts, or larger cells.</source>
      <translation>Die Grenze für {limit} ist mit diesen Radien nicht einzuhalten: {use:.0%} davon sind genutzt. Dickere Streben erlauben, oder größere Zellen.</translation>
    </message>
    <message>
      <source>The lowest natural one, held as in the first case; 0 for no limit</source>
      <translation>Die niedrigste Eigenfrequenz, gehalten wie im ersten Fall; 0 für keine Grenze</translation>
    </message>
    <message>
      <source>The thinnest strut that the process prints</source>
      <translation>Die dünnste Strebe, die das Verfahren druckt</translation>
    </message>
    <message>
      <source>Thermal resistance: {resistance} K/W.</source>
      <translation>Wärmewiderstand: {resistance} K/W.</translation>
    </message>
    <message>
      <source>Thickest skin</source>
      <translation>Dickste Haut</translation>
    </message>
    <message>
      <source>Thinnest skin</source>
      <translation>Dünnste Haut</translation>
    </message>
    <message>
      <source>What the stiffest struts weigh, with a skin that is sized; 0 for what those of StrutRadius and the present skin do</source>
      <translation>Was die steifsten Streben wiegen, mit einer Haut, die bemessen wird; 0 für das, was die von StrutRadius und die jetzige Haut wiegen</translation>
    </message>
    <message>
      <source>Where more is needed the part becomes solid; 0 for half the cell size</source>
      <translation>Wo mehr nötig ist, wird das Teil massiv; 0 für die halbe Zellgröße</translation>
    </message>
    <message>
      <source>Work, N mm</source>
      <translation>Arbeit, N mm</translation>
    </message>
    <message>
      <source>Yield safety</source>
      <translation>Fließsicherheit</translation>
    </message>
    <message>
      <source>Yield stress over the largest von Mises stress in a strut; 0 for no limit</source>
      <translation>Fließgrenze geteilt durch die größte Von-Mises-Spannung in einer Strebe; 0 für keine Grenze</translation>
    </message>
    <message>
      <source>buckling</source>
      <translation>Knicken</translation>
    </message>
    <message>
      <source>displacement</source>
      <translation>Verschiebung</translation>
    </message>
    <message>
      <source>frame buckling</source>
      <translation>gemeinsames Knicken</translation>
    </message>
    <message>
      <source>frequency</source>
      <translation>Frequenz</translation>
    </message>
    <message>
      <source>largest radius</source>
      <translation>größter Radius</translation>
    </message>
    <message>
      <source>largest thickness</source>
      <translation>größte Dicke</translation>
    </message>
    <message>
      <source>one radius for all</source>
      <translation>ein Radius für alle</translation>
    </message>
    <message>
      <source>skin stress</source>
      <translation>Spannung der Haut</translation>
    </message>
    <message>
      <source>smallest radius</source>
      <translation>kleinster Radius</translation>
    </message>
    <message>
      <source>smallest thickness</source>
      <translation>kleinste Dicke</translation>
    </message>
    <message>
      <source>stiffness</source>
      <translation>Steifigkeit</translation>
    </message>
    <message>
      <source>stress</source>
      <translation>Spannung</translation>
    </message>
    <message>
      <source>thickened with others</source>
      <translation>mit anderen verdickt</translation>
    </message>
    <message>
      <source>{process}, built along {direction}: struts from {strut} mm thick and {degrees} degrees steep, walls from {wall} mm</source>
      <translation>{process}, gebaut entlang {direction}: Streben ab {strut} mm Dicke und {degrees} Grad Steilheit, Wände ab {wall} mm</translation>
    </message>
    <message>
      <source>{process}, built along {direction}: struts from {strut} mm thick, walls from {wall} mm</source>
      <translation>{process}, gebaut entlang {direction}: Streben ab {strut} mm Dicke, Wände ab {wall} mm</translation>
    </message>
  </context>
  <context>
    <name>VolfrepSlicer</name>
    <message>
      <source>Along</source>
      <translation>Entlang</translation>
    </message>
    <message>
      <source>Bands</source>
      <translation>Bänder</translation>
    </message>
    <message>
      <source>Bottom layers</source>
      <translation>Bodenschichten</translation>
    </message>
    <message>
      <source>Density follows</source>
      <translation>Dichte folgt</translation>
    </message>
    <message>
      <source>Depth, dense core</source>
      <translation>Tiefe, Kern dicht</translation>
    </message>
    <message>
      <source>Depth, dense skin</source>
      <translation>Tiefe, Haut dicht</translation>
    </message>
    <message>
      <source>Direction</source>
      <translation>Richtung</translation>
    </message>
    <message>
      <source>Down to depth</source>
      <translation>Bis Tiefe</translation>
    </message>
    <message>
      <source>FEM result</source>
      <translation>FEM-Ergebnis</translation>
    </message>
    <message>
      <source>Field file</source>
      <translation>Feld-Datei</translation>
    </message>
    <message>
      <source>Fields (*.csv *.txt *.vtu *.vtk)</source>
      <translation>Felder (*.csv *.txt *.vtu *.vtk)</translation>
    </message>
    <message>
      <source>Filament</source>
      <translation>Filament</translation>
    </message>
    <message>
      <source>Filament: {volume} cm³, {mass} g, of which {solid} cm³ are walls and solid layers. Everywhere {even} % would take the same.</source>
      <translation>Filament: {volume} cm³, {mass} g, davon {solid} cm³ Wände und volle Schichten. Überall {even} % brauchte gleich viel.</translation>
    </message>
    <message>
      <source>File</source>
      <translation>Datei</translation>
    </message>
    <message>
      <source>Follows</source>
      <translation>Folgt</translation>
    </message>
    <message>
      <source>Formula</source>
      <translation>Formel</translation>
    </message>
    <message>
      <source>From</source>
      <translation>Von</translation>
    </message>
    <message>
      <source>Layer height</source>
      <translation>Schichthöhe</translation>
    </message>
    <message>
      <source>Line width</source>
      <translation>Linienbreite</translation>
    </message>
    <message>
      <source>Object</source>
      <translation>Objekt</translation>
    </message>
    <message>
      <source>Of each band: the density that is wanted, what the slicer is told so that it lays as much, and the volume of its sparse infill</source>
      <translation>Von jedem Band: die gewünschte Dichte, was dem Slicer genannt wird, damit er so viel legt, und das Volumen seiner lockeren Füllung</translation>
    </message>
    <message>
      <source>Pattern</source>
      <translation>Muster</translation>
    </message>
    <message>
      <source>Percent of x, y, z</source>
      <translation>Prozent aus x, y, z</translation>
    </message>
    <message>
      <source>Print</source>
      <translation>Druck</translation>
    </message>
    <message>
      <source>Quantity</source>
      <translation>Größe</translation>
    </message>
    <message>
      <source>Show Bands</source>
      <translation>Bänder zeigen</translation>
    </message>
    <message>
      <source>Sized lattice</source>
      <translation>Bemessenes Gitter</translation>
    </message>
    <message>
      <source>Slicer</source>
      <translation>Slicer</translation>
    </message>
    <message>
      <source>To</source>
      <translation>Bis</translation>
    </message>
    <message>
      <source>Top layers</source>
      <translation>Deckschichten</translation>
    </message>
    <message>
      <source>Walls</source>
      <translation>Wände</translation>
    </message>
    <message>
      <source>band</source>
      <translation>Band</translation>
    </message>
    <message>
      <source>density</source>
      <translation>Dichte</translation>
    </message>
    <message>
      <source>value:percent</source>
      <translation>Wert:Prozent</translation>
    </message>
  </context>
  <context>
    <name>VolfrepSolids</name>
    <message>
      <source>Axes of the struts</source>
      <translation>Achsen der Streben</translation>
    </message>
    <message>
      <source>Links to one solid for each kind of joint</source>
      <translation>Verknüpfungen auf einen Volumenkörper je Knotenart</translation>
    </message>
    <message>
      <source>One solid of exact surfaces</source>
      <translation>Ein Volumenkörper aus exakten Flächen</translation>
    </message>
    <message>
      <source>One solid of plane faces</source>
      <translation>Ein Volumenkörper aus ebenen Facetten</translation>
    </message>
  </context>
  <context>
    <name>VolfrepStudy</name>
    <message>
      <source>Apply</source>
      <translation>Anwenden</translation>
    </message>
    <message>
      <source>Give this design to the infill, as one undo step</source>
      <translation>Der Füllung diesen Entwurf geben, als ein Schritt zum Rückgängigmachen</translation>
    </message>
    <message>
      <source>Mesh and measure every design</source>
      <translation>Jeden Entwurf vernetzen und messen</translation>
    </message>
    <message>
      <source>Not run yet: choose what varies, then press Start.</source>
      <translation>Noch nicht gelaufen: wählen, was variiert, dann Start drücken.</translation>
    </message>
    <message>
      <source>Open report</source>
      <translation>Bericht öffnen</translation>
    </message>
    <message>
      <source>Poisson's ratio</source>
      <translation>Querkontraktionszahl</translation>
    </message>
    <message>
      <source>Show the table and all plots in the browser</source>
      <translation>Die Tabelle und alle Diagramme im Browser zeigen</translation>
    </message>
    <message>
      <source>Start</source>
      <translation>Start</translation>
    </message>
    <message>
      <source>The infill of this study has gone: choose another one.</source>
      <translation>Die Füllung dieser Studie gibt es nicht mehr: eine andere wählen.</translation>
    </message>
    <message>
      <source>Values: 6, 8, 10, or 6 to 10 in 5</source>
      <translation>Werte: 6, 8, 10, oder 6 to 10 in 5</translation>
    </message>
    <message>
      <source>What varies</source>
      <translation>Was sich ändert</translation>
    </message>
    <message>
      <source>Zener anisotropy</source>
      <translation>Zener-Anisotropie</translation>
    </message>
    <message>
      <source>bulk modulus</source>
      <translation>Kompressionsmodul</translation>
    </message>
    <message>
      <source>conductivity, of the solid's</source>
      <translation>Leitfähigkeit, von der des Vollmaterials</translation>
    </message>
    <message>
      <source>expected mass, g</source>
      <translation>erwartete Masse, g</translation>
    </message>
    <message>
      <source>expected relative density</source>
      <translation>erwartete relative Dichte</translation>
    </message>
    <message>
      <source>expected strut radius, mm</source>
      <translation>erwarteter Strebenradius, mm</translation>
    </message>
    <message>
      <source>expected struts</source>
      <translation>erwartete Streben</translation>
    </message>
    <message>
      <source>expected triangles</source>
      <translation>erwartete Dreiecke</translation>
    </message>
    <message>
      <source>expected volume, mm3</source>
      <translation>erwartetes Volumen, mm3</translation>
    </message>
    <message>
      <source>mass, g</source>
      <translation>Masse, g</translation>
    </message>
    <message>
      <source>memory, GB</source>
      <translation>Speicher, GB</translation>
    </message>
    <message>
      <source>of the solid's</source>
      <translation>von der des Vollmaterials</translation>
    </message>
    <message>
      <source>relative density</source>
      <translation>relative Dichte</translation>
    </message>
    <message>
      <source>shear modulus</source>
      <translation>Schubmodul</translation>
    </message>
    <message>
      <source>shear strength</source>
      <translation>Schubfestigkeit</translation>
    </message>
    <message>
      <source>stiffness across a face</source>
      <translation>Steifigkeit quer über eine Fläche</translation>
    </message>
    <message>
      <source>stiffness along a diagonal</source>
      <translation>Steifigkeit entlang einer Diagonale</translation>
    </message>
    <message>
      <source>stiffness along an edge</source>
      <translation>Steifigkeit entlang einer Kante</translation>
    </message>
    <message>
      <source>strength</source>
      <translation>Festigkeit</translation>
    </message>
    <message>
      <source>strut radius, mm</source>
      <translation>Strebenradius, mm</translation>
    </message>
    <message>
      <source>struts</source>
      <translation>Streben</translation>
    </message>
    <message>
      <source>surface, mm2</source>
      <translation>Oberfläche, mm2</translation>
    </message>
    <message>
      <source>time, s</source>
      <translation>Zeit, s</translation>
    </message>
    <message>
      <source>triangles</source>
      <translation>Dreiecke</translation>
    </message>
    <message>
      <source>volume, mm3</source>
      <translation>Volumen, mm3</translation>
    </message>
    <message>
      <source>{designs}, about {time}</source>
      <translation>{designs}, etwa {time}</translation>
    </message>
    <message>
      <source>{number} designs</source>
      <translation>{number} Entwürfe</translation>
    </message>
  </context>
  <context>
    <name>VolfrepTaskPanel</name>
    <message>
      <source>'{text}' is no direction: write 100, 110, 111 or three numbers such as 1,2,0.</source>
      <translation>'{text}' ist keine Richtung: 100, 110, 111 oder drei Zahlen wie 1,2,0 schreiben.</translation>
    </message>
    <message>
      <source>'{text}' is no value: type one such as 2 mm, a sum such as 2 mm + 1 mm, or = for a formula.</source>
      <translation>'{text}' ist kein Wert: etwa 2 mm eingeben, eine Summe wie 2 mm + 1 mm, oder = für eine Formel.</translation>
    </message>
    <message>
      <source>Along faces</source>
      <translation>Entlang Flächen</translation>
    </message>
    <message>
      <source>Along the skin</source>
      <translation>Entlang der Haut</translation>
    </message>
    <message>
      <source>Cell that is laid in</source>
      <translation>Zelle, die eingelegt wird</translation>
    </message>
    <message>
      <source>Cells</source>
      <translation>Zellen</translation>
    </message>
    <message>
      <source>Cells kept</source>
      <translation>Behaltene Zellen</translation>
    </message>
    <message>
      <source>Clear</source>
      <translation>Leeren</translation>
    </message>
    <message>
      <source>Column of the field</source>
      <translation>Spalte des Felds</translation>
    </message>
    <message>
      <source>Compute</source>
      <translation>Berechnen</translation>
    </message>
    <message>
      <source>Cut the part open on the screen, along a plane that can be moved; once more shows it whole</source>
      <translation>Schneidet das Teil am Bildschirm auf, entlang einer verschiebbaren Ebene; noch einmal zeigt es ganz</translation>
    </message>
    <message>
      <source>Diameter</source>
      <translation>Durchmesser</translation>
    </message>
    <message>
      <source>Distance</source>
      <translation>Abstand</translation>
    </message>
    <message>
      <source>Drain holes</source>
      <translation>Entleerungslöcher</translation>
    </message>
    <message>
      <source>Drain holes in faces</source>
      <translation>Entleerungslöcher in Flächen</translation>
    </message>
    <message>
      <source>Driven by</source>
      <translation>Bestimmt durch</translation>
    </message>
    <message>
      <source>Evened out, times</source>
      <translation>Geglättet, mal</translation>
    </message>
    <message>
      <source>Faces to follow</source>
      <translation>Flächen, denen es folgt</translation>
    </message>
    <message>
      <source>File</source>
      <translation>Datei</translation>
    </message>
    <message>
      <source>Graph file</source>
      <translation>Graph-Datei</translation>
    </message>
    <message>
      <source>Height of layers</source>
      <translation>Höhe der Lagen</translation>
    </message>
    <message>
      <source>Kind of lattice</source>
      <translation>Art des Gitters</translation>
    </message>
    <message>
      <source>Layers</source>
      <translation>Lagen</translation>
    </message>
    <message>
      <source>Look for a file</source>
      <translation>Datei suchen</translation>
    </message>
    <message>
      <source>Make the mesh of these values now and stay in this panel</source>
      <translation>Erzeugt jetzt das Netz zu diesen Werten und bleibt im Aufgabenfenster</translation>
    </message>
    <message>
      <source>Material</source>
      <translation>Werkstoff</translation>
    </message>
    <message>
      <source>Networks</source>
      <translation>Netzwerke</translation>
    </message>
    <message>
      <source>Of faces with a skin of their own: the thickness of those that are picked next; a face that has another gets it, one that has it goes back to the usual skin, and 0 leaves it open. Of drain holes: the diameter of all. Of what is kept solid: the distance from all its faces</source>
      <translation>Von Flächen mit eigener Haut: die Dicke derer, die als Nächstes gewählt werden; eine Fläche mit anderer Dicke bekommt diese, eine mit dieser Dicke wieder die übliche Haut, und 0 lässt sie offen. Von Entleerungslöchern: der Durchmesser aller. Von dem, was massiv bleibt: der Abstand von allen seinen Flächen</translation>
    </message>
    <message>
      <source>On the other side</source>
      <translation>Auf der anderen Seite</translation>
    </message>
    <message>
      <source>Pick</source>
      <translation>Anklicken</translation>
    </message>
    <message>
      <source>Points</source>
      <translation>Punkte</translation>
    </message>
    <message>
      <source>Points and values</source>
      <translation>Punkte und Werte</translation>
    </message>
    <message>
      <source>Preview</source>
      <translation>Vorschau</translation>
    </message>
    <message>
      <source>Process</source>
      <translation>Verfahren</translation>
    </message>
    <message>
      <source>Section</source>
      <translation>Schnitt</translation>
    </message>
    <message>
      <source>Seed</source>
      <translation>Startwert</translation>
    </message>
    <message>
      <source>Sheet or skeleton</source>
      <translation>Blatt oder Skelett</translation>
    </message>
    <message>
      <source>Sheet thickness</source>
      <translation>Wanddicke</translation>
    </message>
    <message>
      <source>Shortest strut</source>
      <translation>Kürzeste Strebe</translation>
    </message>
    <message>
      <source>Shows the solid: click at a face, an edge, a vertex, an axis or a plane; once more ends it</source>
      <translation>Zeigt den Körper: auf eine Fläche, eine Kante, einen Punkt, eine Achse oder eine Ebene klicken; noch einmal beendet es</translation>
    </message>
    <message>
      <source>Skin thickness</source>
      <translation>Hautdicke</translation>
    </message>
    <message>
      <source>TPMS</source>
      <translation>TPMS</translation>
    </message>
    <message>
      <source>Target relative density</source>
      <translation>Relative Zieldichte</translation>
    </message>
    <message>
      <source>Thickness</source>
      <translation>Dicke</translation>
    </message>
    <message>
      <source>Thickness at the end</source>
      <translation>Dicke am Ende</translation>
    </message>
    <message>
      <source>Thickness at the start</source>
      <translation>Dicke am Anfang</translation>
    </message>
    <message>
      <source>Thickness curve</source>
      <translation>Kurve der Dicke</translation>
    </message>
    <message>
      <source>Thickness field</source>
      <translation>Feld der Dicke</translation>
    </message>
    <message>
      <source>Thickness formula</source>
      <translation>Formel der Dicke</translation>
    </message>
    <message>
      <source>Thickness grading</source>
      <translation>Abstufung der Dicke</translation>
    </message>
    <message>
      <source>Thickness profile</source>
      <translation>Verlauf der Dicke</translation>
    </message>
    <message>
      <source>Thickness reach</source>
      <translation>Reichweite der Dicke</translation>
    </message>
    <message>
      <source>Thickness, diameter or distance</source>
      <translation>Dicke, Durchmesser oder Abstand</translation>
    </message>
    <message>
      <source>To print</source>
      <translation>Zum Drucken</translation>
    </message>
    <message>
      <source>Unit cells</source>
      <translation>Zellen</translation>
    </message>
    <message>
      <source>What to pick</source>
      <translation>Was angeklickt wird</translation>
    </message>
    <message>
      <source>automatic</source>
      <translation>automatisch</translation>
    </message>
    <message>
      <source>drag an end of the arrow in the view to turn it</source>
      <translation>ein Ende des Pfeils in der Ansicht ziehen, um ihn zu drehen</translation>
    </message>
    <message>
      <source>nothing picked</source>
      <translation>nichts angeklickt</translation>
    </message>
  </context>
  <context>
    <name>VolfrepWorkbench</name>
    <message>
      <source>Fill a solid with a strut lattice, ready for the printer</source>
      <translation>Füllt einen Volumenkörper mit einem Strebengitter, fertig für den Drucker</translation>
    </message>
  </context>
  <context>
    <name>Workbench</name>
    <message>
      <source>Examples</source>
      <translation>Beispiele</translation>
    </message>
  </context>
</TS>
